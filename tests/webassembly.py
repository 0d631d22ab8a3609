"""Run the WebAssembly modules from Python with wasmtime, on copies of a run's arrays."""

import ctypes
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from neorl.browser import wasm, worlds
from neorl.browser.worlds import IN_THE_PLANE, PlaneState, rules_of
from neorl.core.layout import CUT, TRACK
from neorl.kernels.annotations import array, arrays, fields, length, mapped, new_tuple
from neorl.worlds.rollout import Log

wasmtime = pytest.importorskip("wasmtime")

PAGE = 2**16
RECORDS = {"TRACK": TRACK, "CUT": CUT}


@cache
def compiled(name="plane"):
    engine = wasmtime.Engine()
    return engine, wasmtime.Module(engine, wasm.modules()[name])


layout_of = cache(wasm.layout)


def module_of(run):
    return "plane" if isinstance(run.world, IN_THE_PLANE) else "helm"


class Machine:
    """A module with a memory of its own, into which arrays are copied once and then accessed by views."""

    def __init__(self, megabytes=64, name="plane"):
        engine, module = compiled(name)
        self.layout = layout_of(name)
        self.store = wasmtime.Store(engine)
        pages = megabytes * 2**20 // PAGE
        self.memory = wasmtime.Memory(self.store, wasmtime.MemoryType(wasmtime.Limits(pages, None)))
        self.exports = wasmtime.Instance(self.store, module, [self.memory]).exports(self.store)
        self.end = self.exports["__heap_base"].value(self.store)

    def put(self, values):
        """Copy an array into the memory: (address, view of the copy)."""
        address = -(-self.end // 64) * 64
        self.end = address + values.nbytes
        base = ctypes.addressof(self.memory.data_ptr(self.store).contents)
        view = np.ctypeslib.as_array((ctypes.c_uint8 * max(values.nbytes, 1)).from_address(base + address))
        view = view[: values.nbytes].view(values.dtype).reshape(values.shape)
        view[...] = values
        return address, view

    def put_tuple(self, values):
        """Copy the arrays of a named tuple and of the tuples within; returns it with (address, view) pairs instead."""
        return mapped(self.put, values)

    def call(self, name, sizes, **arguments):
        """Call an export by its layout; arrays are given as (address, view) pairs."""
        export = self.layout["exports"][name]
        table, _ = self.put(np.array(list(self.words(arguments, export["arguments"], sizes)), np.int64))
        result, view = self.put(np.zeros(1, export["result"] or "int64"))
        assert self.exports[name](self.store, result, 0, table) == 0
        return view[0]

    def words(self, values, kinds, sizes):
        """The words of a table."""
        for name, kind in kinds:
            if isinstance(kind, str):
                yield from self.words(values[name]._asdict(), self.layout["tuples"][kind], sizes)
                continue
            dtype, shape = kind
            if dtype == "Agent":
                yield values[name][0]
                continue
            if shape is None:
                yield np.array(values[name], float if dtype.startswith("float") else int).view(np.int64)
                continue
            address, view = values[name]
            assert view.dtype == RECORDS.get(dtype, dtype), name
            assert view.shape == tuple(length(each, sizes) for each in shape), name
            yield from (address, *view.shape)


def sizes_of(run):
    found = {}
    for values in (run.memory, Span(run.state.here, run.state.push)):
        for name, (_, shape) in fields(type(values)).items():
            found |= {size: length for size, length in zip(shape, getattr(values, name).shape) if isinstance(size, str)}
    return found | {"things": run.world.things, "kinds": len(run.world.kinds), "words": 0, "bins": 1, "recorded": 0,
                    "episodes": 0,
                    **{name: worlds.sizes_of(run.world)[name] for name in ("obstacles", "places", "trials")}}


class Span(NamedTuple):
    here: array("float64", "axes")
    push: array("float64", "actions", "axes")


def widened(record, name):
    """An agent's record with as many rows as those of a module."""
    wide = np.zeros((), wasm.MODULES[name].record)
    for field in record.dtype.names:
        if wide[field].shape != record[field].shape:
            wide[field][: len(record[field])] = record[field]
        else:
            wide[field] = record[field]
    return wide


def state_of(run):
    """The state of a run's world, in the form that its module expects."""
    if module_of(run) != "plane":
        return run.world_state
    plane = new_tuple(PlaneState, sizes_of(run), {})
    given = arrays(run.world_state)
    for name, values in arrays(plane).items():
        values[...] = given.get(name, 0)
    return plane


def copied(run):
    """A machine with copies of a run's arrays, and the arguments of its exports."""
    machine = Machine(32 + run.memory.q.nbytes // 2**20, module_of(run))
    world_state = machine.put_tuple(state_of(run))
    return machine, sizes_of(run), {
        "agent": machine.put(widened(run._record, module_of(run))), "memory": machine.put_tuple(run.memory),
        "rules": machine.put_tuple(rules_of(run.world)), "world_state": world_state, "scene": world_state.scene,
        "log": machine.put_tuple(new_tuple(Log, sizes_of(run), {
            "bin_steps": 2**40, "first_step": 0, "frame_steps": 1}))}
