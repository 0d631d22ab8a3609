"""Compile the kernels of the papers' agents, and then the WebAssembly modules of the Explorer, one after the other.

Binder runs this when it builds its image (``.binder/postBuild``), so that its sessions find all of them in the cache.
Two WebAssembly modules at once would need twice the memory.
"""

from neorl import WaterWorld, forager, multimodal, network_d, place_cells, simulate
from neorl.browser import wasm


def main():
    for agent in (place_cells([3]), multimodal(), network_d(), forager()):
        simulate(agent, WaterWorld(), steps=100, runs=1, progress=False)
    with wasm._one_process_at_a_time():
        for name in wasm.MODULES:
            if name not in wasm._on_disk():
                wasm._kept(wasm._built([name]))


if __name__ == "__main__":
    main()
