"""The extension under the name and in the place that Blender 4.2 gives it, in the Blender that is here:
it starts, restyles, and keeps learnt styles in its own folder."""

import importlib
import os
import re
import sys
import zipfile

import bpy

program, library_zip, folder = sys.argv[sys.argv.index('--') + 1:][:3]
NAME = 'bl_ext.user_default.panache'
installed = os.path.join(folder, 'modules', *NAME.split('.'))
with zipfile.ZipFile(library_zip.removesuffix('.zip') + '-extension.zip') as archive:
    archive.extractall(installed)
sys.path.append(os.path.join(folder, 'modules'))
with open(os.path.join(installed, 'blender_manifest.toml')) as file:
    for wheel in re.findall(r'"\./(wheels/[^"]+)"', file.read()):
        with zipfile.ZipFile(os.path.join(installed, wheel)) as archive:
            archive.extractall(os.path.join(folder, 'site-packages'))
sys.path.append(os.path.join(folder, 'site-packages'))
own = os.path.join(folder, 'own')


def extension_path_user(package, path='', create=False):
    """As Blender 4.2 has it."""
    assert package == NAME
    os.makedirs(os.path.join(own, path), exist_ok=create)
    return os.path.join(own, path)


class Utils:
    """bpy.utils with what is new in 4.2."""
    def __getattr__(self, name):
        return getattr(utils, name)


utils, bpy.utils = bpy.utils, Utils()
bpy.utils.extension_path_user = extension_path_user
# Older versions enable no module of a package, so what they do is done by hand.
bpy.context.preferences.addons.new().module = NAME
extension = importlib.import_module(NAME)
extension.register()
settings = sys.modules[NAME + '.settings']
assert 'old' in settings.model().styles
assert settings.SHIPPED.startswith(os.path.join(folder, 'site-packages', 'panache')), settings.SHIPPED
assert bpy.context.preferences.addons[NAME].preferences is not None
with open(settings.SHIPPED, 'rb') as file:
    settings.keep_learnt(file.read())
assert os.listdir(own) == ['styles.safetensors'], os.listdir(own)
assert settings.model().path == os.path.join(own, 'styles.safetensors')
assert bpy.context.preferences.addons[NAME].preferences.model == settings.model().path
assert not os.path.exists(os.path.join(os.environ['BLENDER_USER_CONFIG'], 'panache'))
extension.unregister()
print('ok')
