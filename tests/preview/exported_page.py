# SPDX-License-Identifier: BSD-3-Clause
"""Reads the data in a page of `meniscus export page`."""

import json
import re
import zlib


def parts_of(data):
    """Returns the parts of PageData::bytes()."""
    words = memoryview(data[:len(data) // 4 * 4]).cast("I")
    sizes, at, parts = words[1:words[0] + 1], 4 * (words[0] + 1), []
    for size in sizes:
        parts.append(data[at:at + size])
        at += size
    assert at == len(data)
    return parts


def page_of(text):
    """Returns the description of an exported page and its tables, whose records are restored."""
    count, letters = re.search(r'id="data" data-bytes="(\d+)">([^<]*)<', text).groups()
    values = {chr(code): n for n, code in enumerate(c for c in range(33, 127) if chr(c) not in "&<>")}
    known = [values[letter] for letter in letters if letter > " "]
    bits, waiting, data = 0, 0, bytearray()
    for first, second in zip(known[::2], known[1::2]):
        waiting |= (first * 91 + second) << bits
        bits += 13
        while bits >= 8:
            data.append(waiting & 255)
            waiting >>= 8
            bits -= 8
    if len(data) < int(count):
        data.append(waiting & 255)
    parts = [zlib.decompress(part) for part in parts_of(bytes(data[:int(count)]))]
    description, tables = json.loads(parts[0]), {}
    for name, (part, stride) in description.pop("tables").items():
        records = len(parts[part]) // stride
        table = bytearray(len(parts[part]))
        for byte in range(stride):
            table[byte::stride] = parts[part][byte * records:(byte + 1) * records]
        tables[name] = bytes(table)
    return description, tables
