"""Arrays in a file with metadata in JSON: an npz file with a digest of all of it.

Nothing in a file is trusted: what an array must be is compared with what the file says that it is before memory is
taken for it, and the digest reveals damage. What the numbers mean is checked by the part of the package that asked.
"""

import contextlib
import hashlib
import io
import json
import math
import zipfile
from pathlib import Path

import numpy as np

from neorl.common.container import usable_bytes
from neorl.common.files import write_whole

FORMAT = 2  # the version of these files
MOST_ABOUT = 2**28  # bytes of metadata
HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


def write_arrays(path, kind, about, arrays, write=np.savez):
    """Write arrays to a file.

    kind, about: the kind of content, and its metadata, a dict. write: `numpy.savez` or `numpy.savez_compressed`.
    """
    text = json.dumps({"format": FORMAT, "is": kind, **about})
    digest = hashlib.sha256(text.encode())
    for name in sorted(arrays):
        _add(digest, name, arrays[name])
    content = io.BytesIO()
    write(content, about=np.array(text), digest=np.array(digest.hexdigest()), **arrays)
    write_whole(path, content.getbuffer())


class ArrayFile:
    """An open file that `write_arrays` has written.

    about: its metadata. shapes: {name: (dtype, shape)} of its arrays, of which nothing has been read yet.
    """

    def __init__(self, path, kind):
        self.path, self._zip = path, zipfile.ZipFile(path)
        self.shapes = {name.removesuffix(".npy"): self._header(name) for name in self._zip.namelist()}
        if max(_size(*self.shapes.pop(name)) for name in ("about", "digest")) > MOST_ABOUT:
            raise ValueError("its metadata are too long")
        self._text, self._digest = (str(self._content(name)) for name in ("about", "digest"))
        self.about = json.loads(self._text)
        known, holds = self.about.get("format"), self.about.get("is")
        if isinstance(known, int) and known > FORMAT:
            raise _Refusal(f"{path} must be of format {FORMAT}, but is of {known}; a newer neorl has written it: "
                           "update yours")
        if (known, holds) != (FORMAT, kind):
            raise _Refusal(f"{path} must hold a {kind} of format {FORMAT}, but holds a {holds} of format {known}")

    def check(self, shapes):
        """Raise ValueError unless the file has arrays of these types and shapes, {name: (dtype, shape)}, and no others.

        MemoryError if they do not fit into the free memory.
        """
        for name in sorted({*self.shapes, *shapes}):
            if self.shapes.get(name) != shapes.get(name):
                raise ValueError(f"{self.path}: {name} must be {_in_words(shapes.get(name))}, but is "
                                 f"{_in_words(self.shapes.get(name))}; the file is of another version of neorl")
        usable_bytes(sum(_size(*each) for each in shapes.values()), f"{self.path} needs", "free some")

    def read(self, shapes):
        """The arrays of the file, {name: array}. shapes: as in `check`; raises what `read_into` raises."""
        self.check(shapes)
        arrays = {name: np.empty(shape, dtype) for name, (dtype, shape) in shapes.items()}
        self.read_into(arrays)
        return arrays

    def read_into(self, arrays):
        """Read all arrays into others, {name: array}. If their digest is wrong, these hold what was read all the same.

        Raises what `check` raises for them, and ValueError for content that is damaged.
        """
        self.check({name: (array.dtype, array.shape) for name, array in arrays.items()})
        digest = hashlib.sha256(self._text.encode())
        with _reading(self.path):
            for name in sorted(arrays):
                content = self._content(name)
                _add(digest, name, content)
                arrays[name][...] = content
            if digest.hexdigest() != self._digest:
                raise ValueError("its digest is another")

    def _header(self, name):
        with self._zip.open(name) as member:
            shape, _, dtype = HEADERS[np.lib.format.read_magic(member)](member)
        return dtype, shape

    def _content(self, name):
        with self._zip.open(f"{name}.npy") as member:
            return np.lib.format.read_array(member, allow_pickle=False)


class _Refusal(ValueError):
    """What is wrong with a file that is sound."""


@contextlib.contextmanager
def open_arrays(path, kind):
    """Open an `ArrayFile`, for the duration of a `with`.

    Raises OSError if there is no such file, ValueError if it is damaged, or of another kind or version, MemoryError if
    there is no memory left.
    """
    path = Path(path)
    path.open("rb").close()
    with _reading(path):
        file = ArrayFile(path, kind)
    with file._zip:
        yield file


@contextlib.contextmanager
def _reading(path):
    """Within this context, an error means that a file is damaged: zip, NumPy and JSON may raise anything for it."""
    try:
        yield
    except (MemoryError, _Refusal):
        raise
    except Exception as error:
        raise ValueError(f"{path} must be a file of neorl's, but is damaged, or another's: {error!r}") from error


def _size(dtype, shape):
    return dtype.itemsize * math.prod(shape)


def _in_words(array):
    return "absent" if array is None else f"{array[0]} {array[1]}"


def _add(digest, name, array):
    digest.update(f"{name} {array.dtype} {array.shape}".encode())
    digest.update(np.ascontiguousarray(array).data)
