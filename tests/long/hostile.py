#!/usr/bin/env python3
"""hostile.py PROGRAM MODEL MEGABYTES [SLACK]: files of that size, made to cost time or memory.

Each is read by `panache info`, restyled, and converted to another format. A run may take a second
of processor time and kSecondsPerMegabyte for the file, and as much memory as kMemoryBase and
kMemoryPerByte for the file. Of an archive that is smaller than what is in it, that counts. It ends
with 0, or with 1 and a message. SLACK allows that many times as much, for slow and busy machines.

Ends with 1 and the runs that did not, and prints what cost most; with -v after these, all runs."""
import io
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import zipfile

kSecondsPerMegabyte = 1.0
kMemoryBase = 300 << 20
kMemoryPerByte = 200
kJoints = 10_000  # As many as are read.
kDepth = 1_000
kMembers = 980  # About as many as an object of glTF may have.
kAnimations = 10_000
kUnpacked = 32 << 20  # Bytes of arrays in an archive that may be small.


# BVH.

def bvh(joints, frames, frame_time='0.01'):
    return (f'HIERARCHY\n{joints}MOTION\nFrames: {len(frames)}\nFrame Time: {frame_time}\n' +
            '\n'.join(frames) + '\n')


def chain(count, depth, channels, name='j'):
    """`count` joints in rows below the first, each `depth` deep; the first has `channels`."""
    lines, closing = [f'ROOT {name}\n{{\nOFFSET 0 0 0\nCHANNELS {channels}\n'], []
    for i in range(1, count):
        if (i - 1) % (depth - 1) == 0:
            lines += closing
            closing = []
        lines.append(f'JOINT {name}\n{{\nOFFSET 0 1 0\nCHANNELS 0\n')
        closing.append('}\n')
    return ''.join(lines + closing) + '}\n'


def bvh_files(size):
    root = 'ROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n'
    yield 'one-joint', bvh(root + '}\n', ['0'] * (size // 2))
    skeleton = chain(kJoints, kDepth, '1 Xrotation')
    still = max(1, min(4 * size // kJoints, (size - len(skeleton)) // 2))
    yield 'still-joints', bvh(skeleton, ['0'] * still) + '\n' * max(0, size - len(skeleton))
    bushy = chain(kJoints, 2, '1 Xrotation')
    yield 'bushy', bvh(bushy, ['0'] * still) + '\n' * max(0, size - len(bushy))
    for depth in (20, 33):
        yield f'limbs-of-{depth}', bvh(chain(kJoints, depth, '1 Xrotation'), ['0'])
    for name in ('LeftHand', 'LeftForeArm.001', 'Head', 'Spine'):
        yield 'all-' + name, bvh(chain(kJoints, kDepth, '1 Xrotation', name), ['0'])
    person = [['LeftHand', 'RightHand', 'LeftFoot', 'RightFoot', 'Head'][i * 5 // kJoints]
              for i in range(kJoints)]
    names = iter(person)
    yield 'persons-of-rows', bvh(''.join(
        part + next(names) if i else part
        for i, part in enumerate(chain(kJoints, kDepth, '1 Xrotation', '?').split('?'))), ['0'])
    moving = chain(kJoints, kDepth, '0').replace(
        'CHANNELS 0', 'CHANNELS 3 Xrotation Yrotation Zrotation')
    line = ' '.join(['1'] * 3 * kJoints)
    yield 'moving-joints', bvh(moving, [line] * max(1, (size - len(moving)) // len(line)))
    yield 'long-name', bvh(root.replace('a', 'a' * size) + '}\n', ['0'])
    yield 'long-number', bvh(root + '}\n', ['1' * size])
    yield 'long-fraction', bvh(root + '}\n', ['0.' + '9' * size])
    yield 'long-exponent', bvh(root + '}\n', ['1e-' + '9' * size])
    yield 'spaces', bvh(root + ' ' * size + '}\n', ['0'])
    yield 'lines', bvh(root + '\r\n' * (size // 2) + '}\n', ['0'])
    yield 'ends', bvh(root + 'End Site\n{\nOFFSET 0 0 0\n}\n' * (size // 27) + '}\n', ['0'])
    yield 'roots', bvh(''.join(f'ROOT r{i}\n{{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n}}\n'
                               for i in range(kJoints)),
                       [' '.join('0' * kJoints)] * max(1, size // (2 * kJoints)))
    yield 'more-frames', bvh(root + '}\n', ['0'] * (size // 2)).replace(
        f'Frames: {size // 2}', 'Frames: 1')
    yield 'bad-end', bvh(root + '}\n', ['0'] * (size // 2)) + 'x'


# glTF.

def glb(document, data=b''):
    if data:
        document['buffers'] = [{'byteLength': len(data)}]
    text = json.dumps(document, separators=(',', ':')).encode()
    return glb_of(text, data)


def glb_of(text, data=b''):
    text += b' ' * (-len(text) % 4)
    data += b'\0' * (-len(data) % 4)
    chunks = struct.pack('<I4s', len(text), b'JSON') + text
    if data:
        chunks += struct.pack('<I4s', len(data), b'BIN\0') + data
    return struct.pack('<4sII', b'glTF', 2, 12 + len(chunks)) + chunks


def accessor(view, count, kind, component=5126, **more):
    return {'bufferView': view, 'componentType': component, 'count': count, 'type': kind, **more}


def row_of_nodes(count, depth, name='n'):
    """Nodes in rows below the first, each `depth` deep."""
    nodes = [{'name': name, 'translation': [0, 1, 0]} for _ in range(count)]
    for i in range(1, count):
        parent = 0 if (i - 1) % (depth - 1) == 0 else i - 1
        nodes[parent].setdefault('children', []).append(i)
    return nodes


def turning(nodes, samplers, each=1):
    return {'channels': [{'sampler': i % samplers,
                          'target': {'node': i % nodes, 'path': 'rotation'}} for i in range(each)],
            'samplers': [{'input': 0, 'output': 1}] * samplers}


def gltf_files(size):
    # A long animation of two keys, on all nodes: a small file, or one as large as is asked for.
    def two_keys(nodes, seconds):
        data = struct.pack('<2f', 0, seconds) + struct.pack('<8f', 0, 0, 0, 1, 0, .6, 0, .8)
        return {'asset': {'version': '2.0'}, 'nodes': nodes,
                'bufferViews': [{'buffer': 0, 'byteLength': 8},
                                {'buffer': 0, 'byteOffset': 8, 'byteLength': 32}],
                'accessors': [accessor(0, 2, 'SCALAR'), accessor(1, 2, 'VEC4')],
                'skins': [{'joints': list(range(len(nodes)))}],
                'animations': [turning(len(nodes), 1)]}, data
    for name, count, seconds in (('one-node', 1, 8000.), ('few-nodes', 60, 8000.),
                                 ('many-nodes', kJoints, 166.), ('hundred', 100, 8000.)):
        document, data = two_keys(row_of_nodes(count, kDepth), seconds)
        yield 'long-' + name, glb(document, data)
        document['animations'] = [turning(count, 1, count)]
        yield 'turning-' + name, glb(document, data)
    document, data = two_keys(row_of_nodes(kJoints, kDepth, 'n' * 900), 1.)
    document['animations'] = [turning(kJoints, 1)] * 100
    yield 'animations-of-long-names', glb(document, data)
    document, data = two_keys(row_of_nodes(2, kDepth), 1.)
    document['animations'] = [{'name': 'a', **turning(2, 1)}] * (size // 110)
    yield 'animations', glb(document, data)
    document['animations'] = [{}] * min(kAnimations, size // 3)
    yield 'still-animations', glb(document, data)
    document['animations'] = [{}] * (size // 3)
    yield 'empty-animations', glb(document, data)
    document, data = two_keys(row_of_nodes(kJoints, kDepth), 1.)
    document = {**{f'x{i}': 0 for i in range(kMembers)}, **document}
    document['animations'] = [turning(kJoints, 1, kJoints)]
    yield 'many-members', glb(document, data)
    # The same keys by many channels.
    keys = size // 20
    data = (struct.pack(f'<{keys}f', *[i / 30 for i in range(keys)]) +
            struct.pack('<4f', 0, 0, 0, 1) * keys)
    shared = {'asset': {'version': '2.0'}, 'nodes': row_of_nodes(1000, kDepth),
              'bufferViews': [{'buffer': 0, 'byteLength': 4 * keys},
                              {'buffer': 0, 'byteOffset': 4 * keys, 'byteLength': 16 * keys}],
              'accessors': [accessor(0, keys, 'SCALAR'), accessor(1, keys, 'VEC4')],
              'animations': [turning(1000, 1, 1000)]}
    yield 'shared-keys', glb(shared, data)
    shared['animations'] = [{'channels': [{'sampler': 0, 'target': {'node': 0, 'path': 'weights'}}],
                             'samplers': [{'input': 0, 'output': 0}]}] * 1000
    yield 'shared-weights', glb(shared, data)
    # Skinned meshes that share their vertices, by nodes and by primitives.
    points = size // 20
    data = b'\0\0\0\0' * points + struct.pack('<4f', 1, 0, 0, 0) * points
    sets = {f'{kind}_{i}': which for i in range(16)
            for which, kind in enumerate(('JOINTS', 'WEIGHTS'))}
    mesh = {'asset': {'version': '2.0'}, 'skins': [{'joints': [0]}],
            'bufferViews': [{'buffer': 0, 'byteLength': 4 * points},
                            {'buffer': 0, 'byteOffset': 4 * points, 'byteLength': 16 * points}],
            'accessors': [accessor(0, points, 'VEC4', 5121), accessor(1, points, 'VEC4')],
            'nodes': [{'mesh': 0, 'skin': 0}] * 5000,
            'meshes': [{'primitives': [{'attributes': sets}] * 100}]}
    yield 'shared-vertices', glb(mesh, data)
    mesh['meshes'] = [{'primitives': [{}] * (size // 3)}]
    yield 'shared-primitives', glb(mesh, data)
    # One value that is written again and again.
    many = size // 12
    data = b'\0\0\0\0' * many + struct.pack('<2f', 0, 1) * many
    again = {'count': many, 'indices': {'bufferView': 0, 'componentType': 5125},
             'values': {'bufferView': 1}}
    sparse = {'asset': {'version': '2.0'}, 'nodes': row_of_nodes(1000, kDepth),
              'bufferViews': [{'buffer': 0, 'byteLength': 4 * many},
                              {'buffer': 0, 'byteOffset': 4 * many, 'byteLength': 8 * many}],
              'accessors': [accessor(1, 1, 'SCALAR', sparse=again),
                            accessor(1, 1, 'VEC4', sparse=again)],
              'animations': [turning(1000, 1, 1000)]}
    yield 'sparse', glb(sparse, data)
    yield 'nested-json', glb_of(b'{"asset":{"version":"2.0"},"extras":' + b'[' * (size // 2) +
                                b']' * (size // 2) + b'}')
    yield 'open-json', glb_of(b'{"a":' * (size // 5))
    for name, value in (('values', b'1,'), ('objects', b'{},'), ('texts', b'"",')):
        yield 'small-' + name, glb_of(b'{"asset":{"version":"2.0"},"extras":[' +
                           value * (size // len(value)) + b'1]}')
    yield 'keys', glb_of(b'{"asset":{"version":"2.0"}' + b''.join(
        b',"%x":1' % i for i in range(size // 10)) + b'}')
    yield 'long-json-number', glb_of(b'{"asset":{"version":"2.0"},"extras":' + b'1' * size + b'}')
    yield 'escapes', glb_of(b'{"asset":{"version":"2.0"},"extras":"' +
                            b'\\u1234' * (size // 6) + b'"}')
    yield 'long-node-name', glb({'asset': {'version': '2.0'}, 'nodes': [{'name': 'n' * size}]})
    yield 'many-nodes', glb({'asset': {'version': '2.0'}, 'nodes': [{}] * (size // 3)})
    yield 'many-children', glb({
        'asset': {'version': '2.0'},
        'nodes': [{'children': list(range(1, kJoints))}] + [{}] * (kJoints - 1),
        'skins': [{'joints': list(range(kJoints))}] * max(1, size // 50_000)})


# Arrays.

def npy(shape, data, kind='<f8'):
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".encode()
    head += b' ' * (63 - (10 + len(head)) % 64) + b'\n'
    return b'\x93NUMPY\x01\0' + struct.pack('<H', len(head)) + head + data


def npz(members):
    out = io.BytesIO()
    with zipfile.ZipFile(out, 'w', zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in members.items():
            archive.writestr(name + '.npy', content)
    return out.getvalue()


def npz_files(size):
    rate = npy('()', struct.pack('<d', 60))
    for name, ratio in (('zeros', 1000), ('some-zeros', 100)):
        frames = size * ratio // (159 * 8)
        yield name, npz({'poses': npy(f'({frames}, 156)', bytes(frames * 156 * 8)),
                         'trans': npy(f'({frames}, 3)', bytes(frames * 3 * 8)),
                         'mocap_framerate': rate})
    for name, ratio in (('small-zeros', 16), ('small-bytes', 16)):
        frames = size * ratio // 159
        yield name, npz({'poses': npy(f'({frames}, 156)', bytes(frames * 156), '|i1'),
                         'trans': npy(f'({frames}, 3)', bytes(frames * 3), '|i1'),
                         'mocap_framerate': rate})
    yield 'others', npz({f'a{i}': bytes(size) for i in range(500)})
    yield 'many', npz({f'a{i}': b'' for i in range(size // 120)})


# Acclaim.

def amc_files(size):
    """Pairs of a skeleton and its motion."""
    head = (':version 1.10\n:units\n angle deg\n:root\n axis XYZ\n order TX TY TZ RX RY RZ\n'
            ' position 0 0 0\n orientation 0 0 0\n:bonedata\n')
    motion = '#!\n:FULLY-SPECIFIED\n:DEGREES\n'
    for name, bones in (('frames', 1), ('bones', kJoints - 1)):
        bone = (' begin\n name b{0}\n direction 0 1 0\n length 1\n axis 0 0 0 XYZ\n end\n')
        skeleton = (head + ''.join(bone.format(i) for i in range(bones)) + ':hierarchy\n begin\n' +
                    ''.join('  %s b%d\n' % ('root' if i % (kDepth - 2) == 0 else f'b{i - 1}', i)
                            for i in range(bones)) + ' end\n')
        yield name, skeleton, motion + ''.join(f'{i + 1}\nroot 0 0 0 0 0 0\n'
                                               for i in range(size // 24))


# Models.

def model_files(size):
    def framed(header, data=b''):
        return struct.pack('<Q', len(header)) + header + data
    yield 'header', framed(b'{' + b','.join(b'"%x":{}' % i for i in range(size // 12)) + b'}')
    yield 'nested', framed(b'{"a":' + b'[' * (size // 2))
    yield 'tensors', framed(b'{' + b','.join(
        b'"%x":{"dtype":"F32","shape":[%d],"data_offsets":[0,%d]}' % (i, size // 8, size // 8 * 4)
        for i in range(size // 2 // 60)) + b'}', bytes(size // 8 * 4))


class Runs:
    def __init__(self, program, model, slack, folder):
        self.program, self.model, self.slack, self.folder = program, model, slack, folder
        self.count = self.rejected = 0
        self.slowest, self.largest = (0, ''), (0, '')
        self.problems = []

    def check(self, what, path, arguments):
        size = os.path.getsize(path)
        if path.endswith('.npz'):
            with zipfile.ZipFile(path) as archive:
                size = max(size, min(sum(member.file_size for member in archive.infolist()),
                                     kUnpacked))
        seconds = self.slack * (1 + size / 1e6 * kSecondsPerMegabyte)
        memory = self.slack * (kMemoryBase + kMemoryPerByte * size)

        def limit():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_CPU, (int(4 * seconds) + 2,) * 2)
            resource.setrlimit(resource.RLIMIT_AS, (12 << 30,) * 2)
        with tempfile.TemporaryFile() as said:
            child = subprocess.Popen([self.program, *arguments], stdout=subprocess.DEVNULL,
                                     stderr=said, preexec_fn=limit, cwd=self.folder,
                                     env={**os.environ, 'PANACHE_MODEL': self.model})
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = code = os.waitstatus_to_exitcode(status)
            said.seek(0)
            message = said.read(2000).decode(errors='replace')
        self.count += 1
        self.rejected += code == 1
        took, peak = used.ru_utime + used.ru_stime, used.ru_maxrss << 10
        about = (f'{what}, {size / 1e6:.2f} MB: panache {" ".join(arguments[:1])}: {took:.2f} s, '
                 f'{peak / 1e6:.0f} MB, exit code {code} {message[:150].strip()!r}')
        if '-v' in sys.argv:
            print(about)
        self.slowest = max(self.slowest, (took / seconds, about))
        self.largest = max(self.largest, (peak / memory, about))
        if code not in (0, 1) or (code == 1 and 'panache: ' not in message):
            self.problems.append(about)
        elif took > seconds or peak > memory:
            self.problems.append(about)

    def read(self, kind, name, content):
        path = os.path.join(self.folder, name + kind)
        with open(path, 'wb') as file:
            file.write(content.encode() if isinstance(content, str) else content)
        self.check(name + kind, path, ['info', path])
        if kind != '.safetensors':
            out = 'out.bvh' if kind == '.amc' else 'out' + kind
            self.check(name + kind, path,
                       ['stylize', path, '--style', 'old=1', '--force', '-o', out])
        if kind in ('.bvh', '.glb'):
            other = '.glb' if kind == '.bvh' else '.bvh'
            self.check(name + kind, path, ['convert', path, '--force', '-o', 'out' + other])
        os.remove(path)


def main():
    wanted = [argument for argument in sys.argv[1:] if argument != '-v']
    if len(wanted) not in (3, 4):
        sys.exit(__doc__)
    program, model = map(os.path.abspath, wanted[:2])
    size = int(float(wanted[2]) * 1e6)
    slack = float(wanted[3]) if len(wanted) == 4 else 1.
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(program, model, slack, folder)
        for kind, files in (('.bvh', bvh_files), ('.glb', gltf_files), ('.npz', npz_files),
                            ('.safetensors', model_files)):
            for name, content in files(size):
                runs.read(kind, name, content)
        for name, skeleton, motion in amc_files(size):
            with open(os.path.join(folder, name + '.asf'), 'w') as file:
                file.write(skeleton)
            runs.read('.amc', name, motion)
        for problem in runs.problems:
            print('hostile:', problem)
        print(f'{runs.count} runs, {runs.rejected} with a message\nslowest: {runs.slowest[1]}\n'
              f'largest: {runs.largest[1]}')
        if runs.problems:
            sys.exit(1)


main()
