"""The kernels in a web page: their WebAssembly modules, the Explorer, and the JavaScript that runs them.

The room uses every room below it: `neorl.drawing`, `neorl.evidence`, `neorl.experiments`, `neorl.agents`,
`neorl.worlds`, `neorl.core`.
"""
