"""The WebAssembly module run from Python by wasmtime, on copies of a run's arrays."""

import ctypes
from functools import cache

import numpy as np
import wasmtime

from neorl.browser import wasm
from neorl.core.kernel import length

PAGE = 2**16


@cache
def compiled():
    engine = wasmtime.Engine()
    return engine, wasmtime.Module(engine, wasm.module())


layout_of_the_module = cache(wasm.layout)


class Machine:
    """A module with a memory of its own, into which arrays are put once and then found again."""

    def __init__(self, megabytes=64):
        engine, module = compiled()
        self.store = wasmtime.Store(engine)
        pages = megabytes * 2**20 // PAGE
        self.memory = wasmtime.Memory(self.store, wasmtime.MemoryType(wasmtime.Limits(pages, None)))
        self.exports = wasmtime.Instance(self.store, module, [self.memory]).exports(self.store)
        self.end = self.exports["__heap_base"].value(self.store)

    def put(self, array):
        """A copy of an array in the memory: (address, a view of it)."""
        address = -(-self.end // 64) * 64
        self.end = address + array.nbytes
        base = ctypes.addressof(self.memory.data_ptr(self.store).contents)
        view = np.ctypeslib.as_array((ctypes.c_uint8 * max(array.nbytes, 1)).from_address(base + address))
        view = view[: array.nbytes].view(array.dtype).reshape(array.shape)
        view[...] = array
        return address, view

    def put_tuple(self, fields):
        """A named tuple whose arrays are (address, view) pairs."""
        return type(fields)(*(self.put(value) if isinstance(value, np.ndarray) else value for value in fields))

    def call(self, name, sizes, **arguments):
        """Call an export as its layout says; arrays are given as (address, view) pairs."""
        layout = layout_of_the_module()
        export = layout["exports"][name]
        values = [int(sizes[each]) for each in export["sizes"]]
        for argument, kind in export["arguments"]:
            given = arguments[argument]
            for field, (dtype, shape) in layout["tuples"][kind] if isinstance(kind, str) else [(None, kind)]:
                value = given if field is None else getattr(given, field)
                if shape is not None:
                    address, view = value
                    assert view.dtype == dtype, (argument, field)
                    assert view.shape == tuple(length(each, sizes) for each in shape), (argument, field)
                    value = address
                values.append(float(value) if shape is None and dtype.startswith("float") else int(value))
        result, view = self.put(np.zeros(1, export["result"] or "int64"))
        assert self.exports[name](self.store, result, 0, *values) == 0
        return view[0]


def sizes_of(run):
    plan = run.plan
    return {"maps": len(plan.cells), "nodes": len(plan.vector), "landmarks": len(plan.landmark),
            "desires": len(plan.source), "values": plan.first[-1], "cells": plan.first_cell[-1],
            "tracks": plan.first_track[-1], "trace": plan.trace, "creeps": run.world.n_creeps, "words": 0, "bins": 1,
            "traces": len(run.memory.strength), "trace_rows": len(run.memory.trace_weight)}


def copied(run):
    """A machine with copies of a run's arrays, and the arguments of its exports."""
    machine = Machine(megabytes=32 + run.memory.q.nbytes // 2**20)
    return machine, sizes_of(run), {
        "plan": machine.put_tuple(run.plan), "memory": machine.put_tuple(run.memory), "rules": run.world.rules,
        "state": machine.put_tuple(run.state), "contacts": machine.put(np.zeros(run.world.n_creeps, np.int8))}
