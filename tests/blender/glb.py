"""Where the joints of a GLB are in one of its animations."""

import bisect
import json
import struct

from mathutils import Matrix, Quaternion, Vector

_SIZES = {'SCALAR': 1, 'VEC3': 3, 'VEC4': 4}


class Glb:
    def __init__(self, path):
        with open(path, 'rb') as file:
            data = file.read()
        size = struct.unpack_from('<I', data, 12)[0]
        self.json = json.loads(data[20:20 + size])
        self.bin = data[28 + size:]
        self.names = [a.get('name') for a in self.json.get('animations', [])]

    def _numbers(self, accessor):
        accessor = self.json['accessors'][accessor]
        assert accessor['componentType'] == 5126, 'floats only'
        view = self.json['bufferViews'][accessor['bufferView']]
        n = _SIZES[accessor['type']]
        at = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
        flat = struct.unpack_from('<%df' % (n * accessor['count']), self.bin, at)
        return [flat[i:i + n] for i in range(0, len(flat), n)]

    def _tracks(self, name):
        animation = self.json['animations'][self.names.index(name)]
        tracks = {}
        for channel in animation['channels']:
            sampler = animation['samplers'][channel['sampler']]
            assert sampler.get('interpolation', 'LINEAR') != 'CUBICSPLINE'
            times = [t[0] for t in self._numbers(sampler['input'])]
            tracks[channel['target']['node'], channel['target']['path']] = (
                times, self._numbers(sampler['output']), sampler.get('interpolation', 'LINEAR'))
        return tracks

    def positions(self, name, seconds):
        """{node: place}, one for each of the moments, metres with Z up as in Blender."""
        tracks = self._tracks(name)
        nodes = self.json['nodes']
        above = {c: i for i, node in enumerate(nodes) for c in node.get('children', [])}

        def value(i, path, moment, rest):
            if (i, path) not in tracks:
                return nodes[i].get(path, rest)
            times, values, interpolation = tracks[i, path]
            k = bisect.bisect_right(times, moment + 1e-5) - 1
            if k < 0 or k + 1 >= len(times) or interpolation == 'STEP':
                return values[max(k, 0)]
            t = max(0.0, (moment - times[k]) / (times[k + 1] - times[k]))
            if path == 'rotation':
                a, b = (Quaternion((q[3], *q[:3])) for q in values[k:k + 2])
                q = a.slerp(b, t)
                return q.x, q.y, q.z, q.w
            return [x + t * (y - x) for x, y in zip(*values[k:k + 2])]

        out = []
        for moment in seconds:
            world = {}

            def matrix(i):
                if i not in world:
                    x, y, z, w = value(i, 'rotation', moment, (0, 0, 0, 1))
                    local = Matrix.LocRotScale(Vector(value(i, 'translation', moment, (0, 0, 0))),
                                               Quaternion((w, x, y, z)),
                                               Vector(value(i, 'scale', moment, (1, 1, 1))))
                    world[i] = matrix(above[i]) @ local if i in above else local
                return world[i]

            found = {}
            for i, node in enumerate(nodes):
                p = matrix(i).translation
                found[node.get('name')] = Vector((p.x, -p.z, p.y))
            out.append(found)
        return out
