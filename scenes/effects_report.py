#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a contact sheet of the effects and a table of what they cost.

    scenes/effects_report.py --raybundle build/raybundle -o DIR [SCENE=EFFECT ...]

DIR/contact_sheet.png: a row for each scene of effects/, with its effect at the left and without it
at the right, exposed alike. DIR/costs.md: milliseconds per iteration and megabytes, one viewer of
320x240 included. DIR/SCENE.png: the rows. Some 15 s for each scene. Python 3, standard library only.
"""
import argparse
import json
import pathlib
import struct
import subprocess
import sys
import zlib

EFFECTS = {
    'punctual_lights': 'punctual-lights',
    'ies_profile': 'ies',
    'overcast_sky': 'sky',
    'clear_sky': 'sun',
    'environment': 'environment',
    'mirror': 'specular-reflection',
    'glass': 'refraction',
    'caustics': 'caustics',
    'clear_coat': 'clear-coat',
    'roughness_texture': 'textures',
    'normal_map': 'normal-maps',
    'diffuse_transmission': 'diffuse-transmission',
}
CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by the colour type of PNG


def read_png(path):
    """(width, height, channels, rows) of an 8-bit PNG that is not interlaced."""
    data = path.read_bytes()
    at, packed, header = 8, b'', None
    while at < len(data):
        length, kind = struct.unpack_from('>I4s', data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b'IHDR':
            header = struct.unpack('>IIBBBBB', body)
        elif kind == b'IDAT':
            packed += body
        at += length + 12
    width, height, depth, colour, _, _, interlaced = header
    if depth != 8 or interlaced or colour not in CHANNELS:
        sys.exit(f'{path}: not an 8-bit picture in whole rows')
    channels = CHANNELS[colour]
    raw, stride = zlib.decompress(packed), width * channels
    rows, before = [], bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        row = unfiltered(raw[start], bytearray(raw[start + 1:start + 1 + stride]), before, channels)
        rows.append(row)
        before = row
    return width, height, channels, rows


def unfiltered(kind, row, before, step):
    """A row of PNG without its filter (specification, 9.2)."""
    for i in range(len(row)):
        left = row[i - step] if i >= step else 0
        corner = before[i - step] if i >= step else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = before[i]
        elif kind == 3:
            guess = (left + before[i]) // 2
        elif kind == 4:
            p = left + before[i] - corner
            guess = min((left, before[i], corner), key=lambda c: abs(p - c))
        else:
            guess = 0
        row[i] = (row[i] + guess) & 255
    return row


def write_png(path, width, rows):
    """rows: of RGB bytes."""
    def chunk(kind, body):
        return (struct.pack('>I', len(body)) + kind + body
                + struct.pack('>I', zlib.crc32(kind + body)))
    raw = b''.join(b'\0' + bytes(row) for row in rows)
    path.write_bytes(b'\x89PNG\r\n\x1a\n'
                     + chunk(b'IHDR', struct.pack('>IIBBBBB', width, len(rows), 8, 2, 0, 0, 0))
                     + chunk(b'IDAT', zlib.compress(raw, 9)) + chunk(b'IEND', b''))


def as_rgb(row, channels):
    if channels == 3:
        return row
    result = bytearray(3 * (len(row) // channels))
    for c in range(3):
        result[c::3] = row[(c if channels == 4 else 0)::channels]
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--raybundle', default='build/raybundle')
    parser.add_argument('-o', dest='folder', type=pathlib.Path, required=True)
    parser.add_argument('scenes', nargs='*', metavar='SCENE=EFFECT')
    arguments = parser.parse_args()
    effects = dict(pair.split('=', 1) for pair in arguments.scenes) or EFFECTS
    scenes = pathlib.Path(__file__).resolve().parent / 'effects'
    arguments.folder.mkdir(parents=True, exist_ok=True)
    sheet, sheet_width = [], 0
    table = ['| scene | effect | ms per iteration: with | without | MB: with | without |',
             '|---|---|---|---|---|---|']
    for scene, effect in effects.items():
        picture = arguments.folder / f'{scene}.png'
        done = subprocess.run(
            [arguments.raybundle, 'inspect', scenes / f'{scene}.gltf', '--effect', effect,
             '--contact-sheet', picture, '--json'], stdout=subprocess.PIPE, check=True)
        cost = json.loads(done.stdout)
        table.append('| `{}` | `{}` | {:.1f} | {:.1f} | {:.1f} | {:.1f} |'.format(
            scene, effect, cost['msPerIteration']['with'], cost['msPerIteration']['without'],
            cost['megabytes']['with'], cost['megabytes']['without']))
        print(table[-1], flush=True)
        width, _, channels, rows = read_png(picture)
        sheet_width = width
        sheet += [as_rgb(row, channels) for row in rows]
    (arguments.folder / 'costs.md').write_text('\n'.join(table) + '\n')
    write_png(arguments.folder / 'contact_sheet.png', sheet_width, sheet)


if __name__ == '__main__':
    main()
