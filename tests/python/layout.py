"""Prints where the fields of the package's structs lie: `struct size` and `struct.field offset`."""

import ctypes

from chamfer import _library

RECORDS = {
    "edge_factor": _library.EDGE_FACTOR,
    "edge_verdict": _library.VERDICT,
    "vertex_source": _library.VERTEX_SOURCE,
    "blend": _library.VERTEX_SOURCE["surface"],
    "triangle_source": _library.TRIANGLE_SOURCE,
}
for kind in vars(_library).values():
    if isinstance(kind, type) and issubclass(kind, ctypes.Structure):
        name = f"chamfer_{kind.__name__[1:].lower()}"
        print(name, ctypes.sizeof(kind))
        for field, *_ in kind._fields_:
            print(f"{name}.{field}", getattr(kind, field).offset)
for name, record in RECORDS.items():
    print(f"chamfer_{name}", record.itemsize)
    for field, (_, offset) in record.fields.items():
        print(f"chamfer_{name}.{field}", offset)
