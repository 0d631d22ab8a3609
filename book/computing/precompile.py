"""Compile the kernels of the papers' agents, and then the WebAssembly modules of the Explorer, one after the other.

Binder runs this when it builds its image (``.binder/postBuild``), so that its sessions find all of them in the cache.
Two WebAssembly modules at once would need twice the memory.
"""

from neorl import WaterWorld, forager, multimodal, network_d, place_cells, simulate
from neorl.browser import wasm

if __name__ == "__main__":
    for agent in (place_cells([3]), multimodal(), network_d(), forager()):
        simulate(agent, WaterWorld(), steps=100, runs=1, progress=False)
    wasm.modules(at_once=1)
