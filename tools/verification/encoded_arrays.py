"""Arrays of numbers as files keep them: as text, in binary, in base64, compressed."""
import base64
import re
import struct
import zlib

from .mesh import Unreadable


class Numbers:
    """`values`, and for each the bytes that it is written as; the places of these bytes in `data`, where they are there."""

    def __init__(self, values, texts, spans=()):
        self.values, self.texts, self.spans = values, texts, list(spans)


def from_text(data, begin, end, count, kind):
    words = [match for match, _ in zip(re.compile(rb'[^\x00-\x20]+').finditer(data, begin, end), range(count))]
    if len(words) < count:
        raise Unreadable('an array is cut short')
    values = [float(word.group()) if kind in 'fd' else int(word.group()) for word in words]
    if kind == 'f':
        values = [struct.unpack('<f', struct.pack('<f', value))[0] for value in values]
    return Numbers(values, [word.group() for word in words], [word.span() for word in words])


def from_bytes(raw, count, kind, order, begin=None):
    """`begin`: place of `raw` in the file, where it lies there as it is."""
    size = struct.calcsize(kind)
    if len(raw) < count * size:
        raise Unreadable('an array is cut short')
    values = struct.unpack_from(f'{order}{count}{kind}', raw)
    spans = [] if begin is None else [(begin + i * size, begin + (i + 1) * size) for i in range(count)]
    return Numbers(list(values), [raw[i * size:(i + 1) * size] for i in range(count)], spans)


def base64_of(text):
    return base64.b64decode(re.sub(rb'\s', b'', text))


def in_blocks(header, body, order, kind):
    """VTK's compressed data. header(size): the first bytes; body(begin, size): bytes behind a header so long."""
    size = struct.calcsize(kind)
    count, whole, last = struct.unpack(f'{order}3{kind}', header(3 * size))
    sizes = struct.unpack(f'{order}{count}{kind}', header((3 + count) * size)[3 * size:])
    packed, at, raw = body((3 + count) * size, sum(sizes)), 0, b''
    for packed_size in sizes:
        raw += zlib.decompress(packed[at:at + packed_size])
        at += packed_size
    if count and len(raw) != whole * (count - 1) + (last or whole):
        raise Unreadable('a compressed array is damaged')
    return raw
