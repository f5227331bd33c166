"""lamp.py WALK.glb LIT.glb LAMP.glb: LIT.glb is WALK.glb with the animation 'lamp', which moves a new
node beside the body, before its own animation; LAMP.glb has that alone. Both are of the frames of
WALK.glb."""

import json
import struct
import sys


def write_glb(path, document, rest):
    text = json.dumps(document).encode()
    text += b' ' * (-len(text) % 4)
    with open(path, 'wb') as file:
        file.write(struct.pack('<4sIII4s', b'glTF', 2, 20 + len(text) + len(rest), len(text),
                               b'JSON') + text + rest)


def write_lamps(walk, lit, lamp):
    with open(walk, 'rb') as file:
        content = file.read()
    end = 20 + struct.unpack_from('<I', content, 12)[0]
    document = json.loads(content[20:end])
    own, = document['animations']
    moved = next(c for c in own['channels'] if c['target']['path'] == 'translation')
    document['scenes'][document.get('scene', 0)]['nodes'].append(len(document['nodes']))
    document['nodes'].append({'name': 'lamp'})
    light = {'name': 'lamp', 'samplers': [own['samplers'][moved['sampler']]],
             'channels': [{'sampler': 0, 'target': {'node': len(document['nodes']) - 1,
                                                    'path': 'translation'}}]}
    for path, animations in ((lit, [light, own]), (lamp, [light])):
        write_glb(path, {**document, 'animations': animations}, content[end:])


if __name__ == '__main__':
    write_lamps(*sys.argv[1:])
