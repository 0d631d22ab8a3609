"""What compiled code takes for a `neorl.core.calls.Table`: a pointer, whose fields are read when they are looked up.

A table is complete before a kernel runs and does not change while it does, so its words are loaded as invariants, and
reading an array from it costs no more than if the array had been an argument.
"""

import functools
from typing import Self

import numpy as np
from llvmlite import ir
from numba import from_dtype, types
from numba.core import cgutils
from numba.core.imputils import lower_getattr_generic
from numba.core.typing.templates import AttributeTemplate, infer_getattr, signature
from numba.extending import NativeValue, lower_builtin, models, register_model, unbox
from numba.np.arrayobj import make_array, populate_array

from neorl.core.kernel import fields, is_tuple

WORD = ir.IntType(64)
SCALARS = {bool: types.boolean, int: types.int64, float: types.float64, np.float32: types.float32,
           None: types.none}


class View(types.Type):
    """The type of a table of a kind of named tuple, with tuples of given lengths among its fields."""

    def __init__(self, kind, lengths=()):
        self.kind, self.lengths = kind, lengths
        super().__init__(f"View({kind.__module__}.{kind.__qualname__}{lengths or ''})")

    def member(self, name):
        """The place of a field, in words, and its type."""
        return _members(self)[name]

    def type_of(self, field):
        """The type of an annotation."""
        if field is Self:
            return self
        if is_tuple(field):
            return View(field)
        if not isinstance(field, tuple):
            return SCALARS[field]
        if len(field) == 2:
            return types.Array(from_dtype(np.dtype(field[0])), len(field[1]), "C")
        return Called(self, field[0])


@functools.cache
def _members(view):
    members, place, lengths = {}, 0, iter(view.lengths)
    for name, field in fields(view.kind).items():
        kind = types.UniTuple(types.int64, next(lengths)) if field is tuple else view.type_of(field)
        members[name] = place, kind
        place += _words(kind)
    return members


class Called(types.Callable):
    """The type of a kernel's address in a table of the type `view`."""

    def __init__(self, view, signature):
        self.view, self.given = view, signature
        super().__init__(f"Called({view}, {signature})")

    @property
    def arguments(self):
        return tuple(map(self.view.type_of, self.given.arguments))

    @property
    def returns(self):
        return SCALARS[self.given.returns]

    def get_call_type(self, context, args, kws):
        return signature(self.returns, *self.arguments, recvr=self)

    def get_call_signatures(self):
        return [self.get_call_type(None, (), {})], False

    def get_impl_key(self, sig):
        return Called


@register_model(View)
class ViewModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, WORD.as_pointer())


@register_model(Called)
class CalledModel(models.PrimitiveModel):
    def __init__(self, manager, kind):
        super().__init__(manager, kind, WORD)


@unbox(View)
def _unboxed(kind, table, c):
    address = c.pyapi.object_getattr_string(table, "address")
    word = c.pyapi.long_as_longlong(address)
    c.pyapi.decref(address)
    return NativeValue(c.builder.inttoptr(word, WORD.as_pointer()))


@infer_getattr
class ViewAttributes(AttributeTemplate):
    key = View

    def generic_resolve(self, view, name):
        return view.member(name)[1] if name in fields(view.kind) else None


@lower_getattr_generic(View)
def _attribute(context, builder, view, pointer, name):
    place, kind = view.member(name)
    if isinstance(kind, types.UniTuple):
        return context.make_tuple(builder, kind, [ir.Constant(WORD, i) for i in range(kind.count)])
    slot = builder.gep(pointer, [ir.Constant(WORD, place)])
    if isinstance(kind, View):
        return slot
    if isinstance(kind, types.Array):
        return _array(context, builder, kind, slot)
    word = _loaded(builder, slot)
    if kind == types.boolean:
        return builder.trunc(word, ir.IntType(1))
    if kind in (types.float32, types.float64):
        number = builder.bitcast(word, ir.DoubleType())
        return builder.fptrunc(number, ir.FloatType()) if kind == types.float32 else number
    return word


def _words(kind):
    """The number of words of a field of a type."""
    if isinstance(kind, View):
        return sum(_words(each) for _, each in _members(kind).values())
    return 0 if isinstance(kind, types.UniTuple) else 1 + getattr(kind, "ndim", 0)


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
        strides.insert(0, builder.mul(strides[0], length, flags=["nsw"]))
    data = _loaded(builder, builder.bitcast(address, data_type.as_pointer().as_pointer()))
    populate_array(array, data, shape, strides, ir.Constant(WORD, size), meminfo=None)
    return array._getvalue()


@lower_builtin(Called, types.VarArg(types.Any))
def _call(context, builder, sig, arguments):
    returns, kinds = sig.return_type, sig.args[1:]
    code = builder.inttoptr(arguments[0], context.call_conv.get_function_type(returns, kinds).as_pointer())
    status, result = context.call_conv.call_function(builder, code, returns, kinds, arguments[1:])
    with cgutils.if_unlikely(builder, status.is_error):
        context.call_conv.return_status_propagate(builder, status)
    return result
