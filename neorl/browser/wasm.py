"""The kernels as WebAssembly modules, so that a page without Python runs the same code as the figures.

There is one for each of `MODULES`, since the numbers of actions and axes are compile-time constants. Numba's LLVM code
of a module's kernels is compiled for WebAssembly by llvmlite as a whole, so that shared functions occur once, and
linked by LLD. No interface is written by hand: what an exported function takes follows from the annotations of its
kernel. Its arguments are a pointer to the result, 0, and a pointer to a table of the kernel's arguments, as in
`neorl.kernels.tables`: eight bytes for a number, and for an array its address and its lengths; named tuples, also
nested ones, field by field, and for an agent's record its address. It returns 0. Memory is the only import; the
caller's part of it begins at the exported
global __heap_base.

A module ships with the wheel that `make wheel` builds, together with a digest of all its sources; elsewhere it is built
on first use and kept on disk. It is built in a separate process, for a generic processor, so that it does not depend on
the machine that built it. There numba leaves optimisation to this module: rarely called functions are not inlined, and
are optimised for size.
"""

import contextlib
import functools
import hashlib
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib import resources
from pathlib import Path
from typing import NamedTuple

import numpy as np

from neorl.agents.embodiment import loop_of
from neorl.agents.keeping import OF_AGENT, OF_DESIRE
from neorl.agents.papers import brownian
from neorl.agents.spaces import pilot
from neorl.browser.seeding import start_stream
from neorl.browser.worlds import PLANE
from neorl.common import files
from neorl.common.container import cores, free_memory
from neorl.common.extras import require
from neorl.common.warn import warn
from neorl.core import contacts, derived, displacement, loop
from neorl.core.building import JOINED, LISTS, SIZES
from neorl.core.choices import Action, Cut, Feature, MapState, Source, Vector
from neorl.core.derived import begin_values, derive
from neorl.core.functions import AgentFunctions, Loop
from neorl.core.layout import CUT, DERIVED, KEEPING, PART_OF, TRACK, WORKING, Memory, agent_type
from neorl.experiments.condition import PARTS, source_digest
from neorl.kernels.annotations import Record, fields, is_tuple
from neorl.kernels.identity import can_cache, digest_of_source
from neorl.worlds import arena, arm, vessel, water_maze, waterworld
from neorl.browser.probe import cell_seen_at, step_alone, step_second, survey
from neorl.worlds.rollout import Log, rollout_in
from neorl.worlds.vessel import Vessel
from neorl.worlds.waterworld import WaterWorld, WaterWorldState
from neorl.worlds.world import Dynamics


class Module(NamedTuple):
    """The contents of a module: worlds, the `Loop` of their agents, and the dtype of their records."""

    dynamics: Dynamics
    loop: Loop
    record: np.dtype
    exports: tuple
    tuples: tuple


def _module(dynamics, agent, world, with_players):
    exports = (start_stream, derive, begin_values, dynamics.reset, loop.begin, rollout_in(dynamics), survey,
               cell_seen_at)
    tuples = Memory, fields(dynamics.reset)["state"], fields(dynamics.reset)["rules"], Log
    if with_players:
        exports, tuples = (*exports, step_second, step_alone), (*tuples, WaterWorldState)
    record = agent_type(len(world.actions.names), world.actions.axes, ROWS)
    return Module(dynamics, loop_of(agent, whole=True), record, exports, tuples)


ROWS = 512  # in the tables of an agent in a page
MODULES = {  # by the name under which a page requests it
    # agents without kernels of the user's own
    "plane": _module(PLANE, brownian(), WaterWorld(), True),
    "helm": _module(Vessel().dynamics, pilot(), Vessel(), False)}  # for the two actions of a rudder
KEPT = {name: (keeping.name, PART_OF[fields(Memory)[name][1][0]]) for name, keeping in KEEPING.items()
        if keeping not in (WORKING, DERIVED)}
ENUMERATIONS = (Action, Cut, Feature, MapState, Source, Vector)
SCALARS = {bool: "bool", int: "int64", float: "float64", np.float32: "float32"}
HOT = "rollout"  # the other exports are called at most once per picture
RARE = (loop.begin, waterworld.reset, waterworld.draw_creep, arena.reset, arm.reset, arm.draw_point, water_maze.reset,
        vessel.reset, vessel.draw_thing, derived.cut_axes, derived.list_desires, contacts.begin_contacts)
EVERY_STEP = loop.act, loop.observe, displacement.observe_self
# Optimised for speed, but not inlined.
APART = (contacts.see, contacts.observe_contacts, contacts.evaluate_contacts, displacement.learn_displacement)
SHIPPED = {name: resources.files(__package__) / f"{name}.wasm" for name in MODULES}  # in a wheel
# Python modules that take part, besides those of a run.
OURS = [f"browser.{name}" for name in ("probe", "seeding", "wasm", "worlds")]
BYTES_OF_A_BUILD = 750 * 2**20
TRIPLE = "wasm32-unknown-unknown"
LAYOUT = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
LINK = ("--no-entry", "--allow-undefined", "--import-memory", "--gc-sections", "--strip-all", "-O2",
        "--export=__heap_base")


def modules(at_once=len(MODULES)):
    """The WebAssembly modules, {name of `MODULES`: bytes}.

    Modules that are neither shipped nor on disk are built, at most `at_once` side by side, which takes about a minute.
    Of several processes one builds them, and the others wait.

    Raises ImportError if a package needed to build them is not installed, RuntimeError if a build fails.
    """
    found = _on_disk()
    if len(found) < len(MODULES):
        with _one_process_at_a_time():
            found = _on_disk()  # another process may have built them
            found |= _kept(_built([name for name in MODULES if name not in found], at_once))
    return found


def found():
    """The WebAssembly modules if all are shipped or on disk, else {}."""
    on_disk = _on_disk()
    return on_disk if len(on_disk) == len(MODULES) else {}


def _on_disk():
    found = {}
    for name, path in SHIPPED.items():
        shipped, digest = files.read_checked(path) or b"", _digest(name)
        content = (shipped[len(digest):] if digest and shipped.startswith(digest) else
                   files.read_checked(_path(name)) if can_cache(*PARTS, *OURS) else None)
        if content is not None:
            found[name] = content
    return found


def _path(name):
    return files.cache_folder() / "wasm" / _digest(name).hex()


@contextlib.contextmanager
def _one_process_at_a_time():
    """Hold a lock, where the system has locks of files and the folder can be written to."""
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(ImportError, OSError):
            import fcntl

            files.cache_folder().mkdir(parents=True, exist_ok=True)
            lock = stack.enter_context(open(files.cache_folder() / "wasm.lock", "w"))
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _kept(contents):
    """The same modules, after writing them to disk."""
    for name, content in contents.items() if can_cache(*PARTS, *OURS) else ():
        try:
            files.write_checked(_path(name), content)
        except OSError as error:
            warn(f"{_path(name).parent} takes no WebAssembly modules ({error.strerror}): they will be built again")
    return contents


def ship(package):
    """Put the modules into `package`, the folder of the package that a wheel is made of."""
    for name, content in modules().items():
        files.write_checked(Path(package) / "browser" / SHIPPED[name].name, _digest(name) + content)


def layout(name="plane"):
    """The interface of a module for its callers, ready for JSON, with lists where the order matters.

    "tuples": for each named tuple its fields, [name, kind]; a kind is [dtype, shape], with the shape None for a scalar,
    or the name of a nested tuple. "records": for each kind of record, "Agent" among them, its "size" and its "fields",
    [name, dtype, offset, shape]; instead of the dtype there may be the name of a kind. "exports": for each function its
    "arguments", [name, kind], and the dtype of its "result". "state" and "rules": the names of the world's tuples.
    "rows": of the tables of a record.
    "enumerations": {name: {member: number}}. "lists", "joined" and "sizes": how an agent is laid out, see
    `neorl.core.building`. "kept": the arrays of an agent's memory that go on as it changes, by what they are kept with
    and what the part of a map begins and ends with; "of_an_agent" and "of_a_desire": the fields of its record that do.
    """
    _, _, record, exports, tuples = MODULES[name]
    return {"state": tuples[1].__name__, "rules": tuples[2].__name__, "rows": ROWS,
            "tuples": {kind.__name__: _described_all(kind) for each in tuples for kind in _with_those_within(each)},
            "records": _records("Agent", record) | _records("TRACK", TRACK) | _records("CUT", CUT),
            "exports": {each.__name__: {"arguments": _described_all(_passed(each)),
                                        "result": SCALARS.get(fields(each)["return"])} for each in exports},
            "enumerations": {kind.__name__: {each.name: int(each) for each in kind} for kind in ENUMERATIONS},
            "lists": LISTS, "joined": JOINED, "sizes": SIZES, "kept": KEPT, "of_an_agent": OF_AGENT,
            "of_a_desire": OF_DESIRE}


def _records(name, dtype):
    """A kind of record, and those within, each named after its field."""
    found = {name: {"size": dtype.itemsize, "fields": [
        [field, field if kind.base.names else str(kind.base), offset, list(kind.shape)]
        for field, (kind, offset, *_) in dtype.fields.items()]}}
    for field, (kind, *_) in dtype.fields.items():
        if kind.base.names:
            found |= _records(field, kind.base)
    return found


def _with_those_within(kind):
    return [kind, *(inner for each in fields(kind).values() if is_tuple(each) for inner in _with_those_within(each))]


def _described_all(kind):
    return [[name, _described(field)] for name, field in fields(kind).items()]


def _described(field):
    if is_tuple(field):
        return field.__name__
    if field is Record:
        return ["Agent", []]
    if isinstance(field, tuple):
        return [{TRACK: "TRACK", CUT: "CUT"}.get(field[0], field[0]), list(field[1])]
    return [SCALARS[field], None]


@functools.cache
def _passed(kernel):
    """The named tuple of a kernel's arguments, which the exported function takes as a table."""
    return NamedTuple(kernel.__name__, [(name, each) for name, each in kernel.__annotations__.items()
                                      if each not in (AgentFunctions, Loop) and name != "return"])


def _digest(name):
    """A digest of the sources alone: by the rules of `neorl.kernels.kernel`, results do not depend on the compiler.

    b"" where there is no source.
    """
    digests = source_digest(), digest_of_source(*OURS)
    return b"" if None in digests else hashlib.sha256("".join([*digests, name]).encode()).digest()


def _built(names, at_once):
    """Build modules, side by side where cores and memory suffice: {name: bytes}."""
    with ThreadPoolExecutor(max(1, min(at_once, cores(), free_memory() // BYTES_OF_A_BUILD))) as pool:
        return dict(zip(names, pool.map(_built_in_a_process_of_its_own, names)))


def _built_in_a_process_of_its_own(name):
    require("ziglang", extra="wasm")
    settings = {"NUMBA_DISABLE_JIT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_OPT": "0"}
    built = subprocess.run([sys.executable, "-m", "neorl.browser.wasm", name], capture_output=True,
                           env=os.environ | settings)
    if built.returncode:
        raise RuntimeError(f"the WebAssembly module was not built:\n{built.stderr.decode()}")
    digest = _digest(name)
    if not built.stdout.startswith(digest):
        raise RuntimeError("neorl must be as it was when it was imported, but its source has changed; restart Python")
    return built.stdout[len(digest):]


def _build(name):
    """Compile and link a module from the code that numba generates in this process."""
    import llvmlite.binding as llvm

    _, loop, record, exports, _ = MODULES[name]
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    for kernel in RARE + APART:
        kernel.dispatcher.targetoptions["forceinline"] = False  # instead of the caller's, which numba would take over
    for kernel in EVERY_STEP:
        kernel.dispatcher.targetoptions["forceinline"] = True
    target = llvm.Target.from_triple(TRIPLE).create_target_machine(features="+simd128,+bulk-memory", opt=3)
    together = _together({kernel.__name__: _code(kernel, loop, record) for kernel in exports})
    passes = llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=3))
    passes.getModulePassManager().run(together, passes)
    with tempfile.TemporaryDirectory() as folder:
        compiled, linked = Path(folder) / "module.o", Path(folder) / "module.wasm"
        compiled.write_bytes(target.emit_object(together))
        wanted = [f"--export={kernel.__name__}" for kernel in exports]
        linker = [sys.executable, "-m", "ziglang", "wasm-ld"]
        subprocess.run([*linker, *LINK, *wanted, compiled, "-o", linked], check=True)
        return linked.read_bytes()


def _together(codes):
    """Merge LLVM modules into one, in which all functions but the exports are internal and may be removed."""
    import llvmlite.binding as llvm

    exports = set(codes)
    module, *others = map(llvm.parse_assembly, codes.values())
    for other in others:
        module.link_in(other)
    rare, apart = ([_mangled(kernel) for kernel in kernels] for kernels in (RARE, RARE + APART))
    for function in module.functions:
        is_rare = any(name in function.name for name in rare)
        if function.name not in exports and not function.is_declaration:
            function.linkage = "internal"
        if any(name in function.name for name in apart):
            function.add_function_attribute("noinline")
        if is_rare or function.name in exports - {HOT}:
            function.add_function_attribute("optsize")
    module.verify()
    return module


def _mangled(kernel):
    """The part that the names of numba's symbols for a kernel contain."""
    return "".join(f"{len(each)}{each}" for each in f"{kernel.__module__}.{kernel.__name__}".split("."))


def _code(kernel, loop, record):
    """The LLVM code of a kernel under its own name, with everything it calls."""
    dispatcher = _entry(kernel, loop, record)
    (compiled,) = dispatcher.overloads.values()
    code = compiled.library.get_llvm_str()
    # As text: llvmlite has no way to change the target and the linkage of code that it has parsed.
    code = re.sub(r"target datalayout = .*", f'target datalayout = "{LAYOUT}"', code)
    code = re.sub(r"target triple = .*", f'target triple = "{TRIPLE}"', code)
    code = re.sub(r'"target-(cpu|features)"="[^"]*"', "", code)
    code = code.replace("= common ", "= internal ")
    return code.replace(f"@{compiled.fndesc.llvm_func_name}(", f"@{kernel.__name__}(")


def _entry(kernel, loop, record):
    """The entry point of a kernel: a function of a table of its arguments. What it calls is compiled into it."""
    import numba

    from neorl.kernels.compiling import options
    from neorl.kernels.tables import SCALARS as TYPES
    from neorl.kernels.tables import View

    taken = [name if each in (AgentFunctions, Loop) else f"passed.{name}" for name, each in fields(kernel).items()
             if name != "return"]
    scope = {"kernel": kernel, "loop": loop, "functions": loop.functions}
    entry = eval(f"lambda passed: kernel({', '.join(taken)})", scope)  # numba has no loop over fields of several types
    result = TYPES[kernel.__annotations__["return"]](View(_passed(kernel), record))
    return numba.njit(result, **options(no_cpython_wrapper=True, no_cfunc_wrapper=True))(entry)


if __name__ == "__main__":
    sys.stdout.buffer.write(_digest(sys.argv[1]) + _build(sys.argv[1]))
