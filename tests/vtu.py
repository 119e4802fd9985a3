# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads .vtu files as the program writes them, for tests: arrays compressed by zlib."""

import base64
import struct
import xml.etree.ElementTree as ElementTree
import zlib

FORMATS = {"Float32": "f", "Int64": "q", "UInt8": "B"}


def values_of(element):
    """The numbers of a data array."""
    text = "".join(element.text.split())
    if element.get("format") == "ascii":
        return [float(text)]
    # Four numbers of 8 bytes are 44 letters of base64.
    head = struct.unpack("<4Q", base64.b64decode(text[:44])) if len(text) > 32 else (0, 0, 0, 0)
    data = zlib.decompress(base64.b64decode(text[44:])) if head[0] else b""
    if len(data) != head[1]:
        raise ValueError(f"array {element.get('Name')}: {len(data)} bytes, not {head[1]}")
    letter = FORMATS[element.get("type")]
    return list(struct.unpack(f"<{len(data) // struct.calcsize(letter)}{letter}", data))


def tuples_of(element):
    """The same by point or cell: numbers, or tuples of the components."""
    values, width = values_of(element), int(element.get("NumberOfComponents", 1))
    return values if width == 1 else [tuple(values[k:k + width]) for k in range(0, len(values), width)]


def read_vtu(path):
    """{"points": [(x, y, z)], "cells": [[point]], "point": {name: values}, "cell": {name: values}, "time": t}"""
    root = ElementTree.parse(path).getroot()
    piece = root.find(".//Piece")
    arrays = {part.tag: {array.get("Name"): tuples_of(array) for array in part} for part in piece}
    ends = arrays["Cells"]["offsets"]
    points_of = arrays["Cells"]["connectivity"]
    return {"points": arrays["Points"]["Points"],
            "cells": [points_of[begin:end] for begin, end in zip([0] + ends[:-1], ends)],
            "point": arrays.get("PointData", {}), "cell": arrays.get("CellData", {}),
            "time": next(values_of(array)[0] for array in root.iter("DataArray") if array.get("Name") == "TimeValue")}
