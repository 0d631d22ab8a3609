"""The kernels in a web page: their WebAssembly modules, the Explorer, and the JavaScript that runs them."""
