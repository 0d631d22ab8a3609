"""The kernels as a WebAssembly module, so that a page without Python runs what the figures were made with.

Numba's LLVM code of each kernel is compiled again for WebAssembly by llvmlite and linked by LLD. Nothing is written
twice: the arguments of an exported function follow from the annotations of its kernel, in their order,

1. the sizes of its arrays, by name, as int32;
2. each argument, a named tuple field by field: a pointer for an array, int32 for integers and flags, else a number;

before them a pointer to the result, and 0. Its own result is 0. Memory is the only import; the caller's part of it
begins at the exported global __heap_base.

A module is kept on disk under a digest of all source that it comes from. It is built in a process of its own, for a
generic processor, so that it does not depend on where it was built.
"""

import hashlib
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import llvmlite
import llvmlite.binding as llvm
import numba
import numpy as np
from numba import carray, cfunc, types

from neorl.core.kernel import fields
from neorl.core.plan import Memory, Plan, know_nothing, lay_out
from neorl.core.stream import start_stream
from neorl.experiments import cache
from neorl.worlds import probe
from neorl.worlds.rollout import begin_tracks, rollout
from neorl.worlds.waterworld import Rules, WaterWorldState, reset_board

EXPORTS = (start_stream, lay_out, know_nothing, reset_board, begin_tracks, rollout, probe.survey, probe.cell_seen_at,
           probe.step_second)
TUPLES = {kind.__name__: kind for kind in (Plan, Memory, Rules, WaterWorldState)}
SCALARS = {bool: "bool", int: "int64", float: "float64", np.float32: "float32"}
TRIPLE = "wasm32-unknown-unknown"
LAYOUT = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
LINK = ("--no-entry", "--allow-undefined", "--import-memory", "--gc-sections", "--strip-all", "-O2",
        "--export=__heap_base")


def module():
    """The WebAssembly module: bytes. Built if it is not on disk, which takes half a minute.

    Raises RuntimeError if that needs something that is not installed.
    """
    path = cache.folder() / "wasm" / _digest()
    content = cache.read_checked(path)
    if content is None:
        if importlib.util.find_spec("ziglang") is None:
            raise RuntimeError("WebAssembly needs LLD, a linker that the package ziglang brings: pip install ziglang")
        environment = {name: value for name, value in os.environ.items() if name != "NUMBA_DISABLE_JIT"}
        built = subprocess.run([sys.executable, "-m", "neorl.browser.wasm"], env=environment | {"NUMBA_CPU_NAME": "generic"},
                               capture_output=True)
        if built.returncode:
            raise RuntimeError(f"the WebAssembly module was not built:\n{built.stderr.decode()}")
        content = built.stdout
        cache.write_checked(path, content)
    return content


def layout():
    """What a caller of the module has to know, ready for JSON; lists where the order matters.

    "tuples": for each named tuple its fields, [name, [dtype, shape]], the shape of a scalar being None. "exports": for
    each function its "sizes", its "arguments", [name, tuple's name or [dtype, shape]], and the dtype of its "result".
    """
    return {"tuples": {name: [[field, _described(each)] for field, each in fields(kind).items()]
                       for name, kind in TUPLES.items()},
            "exports": {each.__name__: {"sizes": _sizes(each), "arguments": list(map(list, _arguments(each).items())),
                                        "result": _result(each)} for each in EXPORTS}}


def _described(field):
    return [field[0], list(field[1])] if isinstance(field, tuple) else [SCALARS[field], None]


def _arguments(kernel):
    return {name: field.__name__ if field in TUPLES.values() else _described(field)
            for name, field in fields(kernel).items() if name != "return"}


def _result(kernel):
    return SCALARS.get(fields(kernel)["return"])


def _flat(kernel):
    """The arguments of a kernel one by one: [(argument, field or "", dtype, shape or None), …]."""
    flat = []
    for name, kind in _arguments(kernel).items():
        of = fields(TUPLES[kind]) if isinstance(kind, str) else {"": None}
        flat += [(name, field, *(_described(each) if field else kind)) for field, each in of.items()]
    return flat


def _sizes(kernel):
    names = {dimension.partition(" ")[0] for *_, shape in _flat(kernel) for dimension in shape or ()
             if isinstance(dimension, str)}
    return sorted(names)


def _digest():
    sources = [Path(__file__), Path(probe.__file__)]
    versions = f"{cache.source_digest()} {numba.__version__} {llvmlite.__version__}"
    return hashlib.sha256(versions.encode() + b"".join(path.read_bytes() for path in sources)).hexdigest()


def _build():
    """The module, for the processor that this process compiles for."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    with tempfile.TemporaryDirectory() as folder:
        objects = []
        for kernel in EXPORTS:
            objects.append(Path(folder) / f"{kernel.__name__}.o")
            objects[-1].write_bytes(_object(kernel))
        linked = Path(folder) / "module.wasm"
        exports = [f"--export={kernel.__name__}" for kernel in EXPORTS]
        linker = [sys.executable, "-m", "ziglang", "wasm-ld"]
        subprocess.run([*linker, *LINK, *exports, *objects, "-o", linked], check=True)
        return linked.read_bytes()


def _object(kernel):
    """The object file of a kernel under its own name."""
    entry = _entry(kernel)
    code = entry.inspect_llvm()
    code = re.sub(r"target datalayout = .*", f'target datalayout = "{LAYOUT}"', code)
    code = re.sub(r"target triple = .*", f'target triple = "{TRIPLE}"', code)
    code = re.sub(r'"target-(cpu|features)"="[^"]*"', "", code)
    code = code.replace("= common ", "= internal ")
    # The first is called by C and may raise in Python, the others count references to arrays, which carray has none of.
    for symbol in ("@cfunc.", "@NRT_incref(", "@NRT_decref("):
        code = _without(code, symbol)
    code += "".join(f"\ndefine internal void @NRT_{name}(ptr %array) {{ ret void }}\n" for name in ("incref", "decref"))
    code = code.replace(f"@{entry.native_name.removeprefix('cfunc.')}(", f"@{kernel.__name__}(")
    parsed = llvm.parse_assembly(code)
    parsed.verify()
    target = llvm.Target.from_triple(TRIPLE).create_target_machine(features="+simd128,+bulk-memory", opt=3)
    passes = llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=3))
    passes.getModulePassManager().run(parsed, passes)
    return target.emit_object(parsed)


def _without(code, symbol):
    """LLVM code without the definition of a function, or its declaration."""
    lines = [line for line in code.splitlines() if line.startswith(("define ", "declare ")) and symbol in line]
    for line in lines:
        begin = code.index(line)
        end = code.index("\n}\n", begin) + 3 if line.startswith("define ") else begin + len(line)
        code = code[:begin] + code[end:]
    return code


def _entry(kernel):
    """A function that takes pointers and sizes, and calls a kernel with arrays."""
    sizes, flat = _sizes(kernel), _flat(kernel)
    calls = []
    for name, kind in _arguments(kernel).items():
        parts = ", ".join(_taken(*each) for each in flat if each[0] == name)
        calls.append(f"{kind}({parts})" if isinstance(kind, str) else parts)
    parameters = [f"size_{name}" for name in sizes] + [f"{name}_{field}" for name, field, *_ in flat]
    source = f"def entry({', '.join(parameters)}):\n    return kernel({', '.join(calls)})"
    scope = {"kernel": kernel, "carray": carray, "np": np, **TUPLES}
    exec(source, scope)
    arguments = [types.int32] * len(sizes) + [_passed(dtype, shape) for *_, dtype, shape in flat]
    result = getattr(types, _result(kernel) or "void")
    return cfunc(result(*arguments), error_model="numpy", nogil=True)(scope["entry"])


def _passed(dtype, shape):
    """The type that stands for a value in the signature."""
    if shape is not None:
        return types.CPointer(numba.from_dtype(np.dtype(dtype)))
    return types.int32 if dtype in ("bool", "int64") else getattr(types, dtype)


def _taken(name, field, dtype, shape):
    """The expression that makes a value of a parameter."""
    parameter = f"{name}_{field}"
    if shape is None:
        return {"bool": f"{parameter} != 0", "int64": f"np.int64({parameter})"}.get(dtype, parameter)
    lengths = [f"np.int64({f'size_{each}' if isinstance(each, str) else each})" for each in shape]
    return f"carray({parameter}, ({', '.join(lengths)},))"


if __name__ == "__main__":
    sys.stdout.buffer.write(_build())
