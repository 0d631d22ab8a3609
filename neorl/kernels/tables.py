"""Tables: the named tuples that kernels take by one pointer, as types of numba's, by its extension API.

A table consists of words, each an address, a length or a number. They do not change while a kernel runs, so they are
loaded as invariants, and reading an array from a table costs no more than if it had been an argument: field by field, a
call of a kernel that is not inlined takes a microsecond for an agent's arrays alone.

A kernel among the fields, with the signature that `neorl.kernels.annotations.function` annotates, is called by its
address. So it is compiled once and by itself, and replacing it compiles nothing else.
"""

import functools
import hashlib

import numpy as np
from llvmlite import ir
from numba import from_dtype, types
from numba.core import cgutils
from numba.core.typing import signature
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (NativeValue, infer_getattr, lower_builtin, lower_getattr_generic, models, register_model,
                             unbox)
from numba.np.arrayobj import make_array, populate_array

from neorl.common import checks
from neorl.kernels.annotations import Record, fields, is_tuple
from neorl.kernels.identity import Reading

WORD = ir.IntType(64)
SCALARS = {bool: types.boolean, int: types.int64, float: types.float64, np.float32: types.float32, None: types.none}


class Table:
    """A named tuple for compiled code. record: the dtype of the agent's record that its functions take."""

    def __init__(self, values, record=None):
        self.values, self._numba_type_, self._users = values, _view(type(values), record), []
        self.words = np.array(list(self._words(values)), np.int64)
        self.address = self.words.ctypes.data  # kept: `ctypes` makes an object at each access

    def _words(self, values):
        for value, (name, field) in zip(values, fields(type(values)).items()):
            if is_tuple(field):
                yield from self._words(value)
            elif field is Record:
                yield value.ctypes.data
            elif not isinstance(field, tuple):
                yield int(value) if field in (bool, int) else int(np.float64(value).view(np.int64))
            elif len(field) == 1:
                yield self._address(field[0], value)
            else:
                yield from _words_of_array(name, value, *field)

    def _address(self, signature, kernel):
        if kernel is None:
            return 0
        types_of_arguments = tuple(map(self._numba_type_.type_of, signature.arguments))
        compiled = kernel.compiled_for(types_of_arguments, SCALARS[signature.returns])
        if Reading(kernel).functions:  # only what the user has written can change
            self._users.append((kernel, compiled.dispatcher))
        return compiled.library.get_pointer_to_function(compiled.name)

    def refresh(self):
        """Compile the user's kernels again if what they look up has changed."""
        if any(kernel.for_python is not compiled for kernel, compiled in self._users):
            self._users = []
            self.words[:] = list(self._words(self.values))


def _words_of_array(name, array, dtype, shape):
    """The words of an array: its address, and its lengths."""
    if array.dtype != dtype or array.ndim != len(shape) or not array.flags.c_contiguous:
        raise ValueError(f"{name} must be a contiguous array of {np.dtype(dtype)} with {len(shape)} axes, but is "
                         f"{checks.shown(array)}")
    return array.ctypes.data, *array.shape


class View(types.Type):
    """The type of a table of a kind of named tuple. record: the dtype that stands for `Record` in it."""

    def __init__(self, kind, record=None):
        self.kind = self.instance_class = kind  # as numba's own types of named tuples call it
        self.record = record if takes_records(kind) else None
        of_record = self.record and hashlib.sha256(str(self.record).encode()).hexdigest()[:16]  # symbols contain it
        super().__init__(f"View({kind.__module__}.{kind.__qualname__}, {of_record})")

    def type_of(self, field):
        """The type of an annotation."""
        if field is Record:
            return _type_of_record(self.record)
        if is_tuple(field):
            return _view(field, self.record)
        if not isinstance(field, tuple):
            return SCALARS[field]
        if len(field) == 2:
            return types.Array(from_dtype(np.dtype(field[0])), len(field[1]), "C")
        return Function(self, field[0])


_view = functools.cache(View)
_type_of_record = functools.cache(from_dtype)  # takes numba ten milliseconds


@functools.cache
def takes_records(kind):
    """Whether a kind of named tuple has a record among its fields, or functions, which may take one."""
    return any(takes_records(field) if is_tuple(field) else field is Record or isinstance(field, tuple)
               and len(field) == 1 for field in fields(kind).values())


@functools.cache
def _members(view):
    """The place of each field, in words, and its type."""
    members, place = {}, 0
    for name, field in fields(view.kind).items():
        kind = view.type_of(field)
        members[name] = place, kind
        place += _length(kind)
    return members


def _length(kind):
    """The number of words of a field of a type."""
    if isinstance(kind, View):
        return sum(_length(field) for _, field in _members(kind).values())
    return 1 + getattr(kind, "ndim", 0)


class Function(types.Callable):
    """The type of a kernel's address in a table of the type `view`."""

    def __init__(self, view, signature):
        self.view, self.signature = view, signature
        super().__init__(f"Function({view}, {signature})")

    def get_call_type(self, context, args, kws):
        return signature(SCALARS[self.signature.returns], *map(self.view.type_of, self.signature.arguments), recvr=self)

    def get_call_signatures(self):
        return [self.get_call_type(None, (), {})], False

    def get_impl_key(self, sig):
        return Function


for pointer in View, Function:
    register_model(pointer)(models.OpaqueModel)


@unbox(View)
def _unboxed(kind, table, c):
    address = c.pyapi.object_getattr_string(table, "address")
    word = c.pyapi.long_as_longlong(address)
    c.pyapi.decref(address)
    return NativeValue(c.builder.inttoptr(word, cgutils.voidptr_t))


@infer_getattr
class ViewAttributes(AttributeTemplate):
    key = View

    def generic_resolve(self, view, name):
        return _members(view)[name][1] if name in fields(view.kind) else None


@lower_getattr_generic(View)
def _attribute(context, builder, view, pointer, name):
    place, kind = _members(view)[name]
    slot = builder.gep(builder.bitcast(pointer, WORD.as_pointer()), [ir.Constant(WORD, place)])
    if isinstance(kind, View):
        return builder.bitcast(slot, cgutils.voidptr_t)
    if isinstance(kind, types.Array):
        return _array(context, builder, kind, slot)
    if isinstance(kind, types.Record):
        return _loaded(builder, builder.bitcast(slot, context.get_value_type(kind).as_pointer()))
    word = _loaded(builder, slot)
    if isinstance(kind, Function):
        return builder.inttoptr(word, cgutils.voidptr_t)
    if kind == types.boolean:
        return builder.trunc(word, ir.IntType(1))
    if kind in (types.float32, types.float64):
        number = builder.bitcast(word, ir.DoubleType())
        return builder.fptrunc(number, ir.FloatType()) if kind == types.float32 else number
    return word


def _loaded(builder, slot):
    word = builder.load(slot)
    word.set_metadata("invariant.load", builder.module.add_metadata([]))
    return word


def _array(context, builder, kind, address):
    data_type = context.get_data_type(kind.dtype)
    array, size = make_array(kind)(context, builder), context.get_abi_sizeof(data_type)
    shape = [_loaded(builder, builder.gep(address, [ir.Constant(WORD, 1 + axis)])) for axis in range(kind.ndim)]
    strides = [ir.Constant(WORD, size)]
    for length in reversed(shape[1:]):
        strides.insert(0, builder.mul(strides[0], length, flags=["nsw"]))  # no overflow
    data = _loaded(builder, builder.bitcast(address, data_type.as_pointer().as_pointer()))
    populate_array(array, data, shape, strides, ir.Constant(WORD, size), meminfo=None)
    return array._getvalue()


@lower_builtin(Function, types.VarArg(types.Any))
def _call(context, builder, sig, arguments):
    returns, kinds = sig.return_type, sig.args[1:]
    code = builder.bitcast(arguments[0], context.call_conv.get_function_type(returns, kinds).as_pointer())
    status, result = context.call_conv.call_function(builder, code, returns, kinds, arguments[1:])
    with cgutils.if_unlikely(builder, status.is_error):
        context.call_conv.return_status_propagate(builder, status)
    return result
