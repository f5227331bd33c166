"""commands_test.py ROOT PROGRAM: every command of the program that the pages print runs as printed,
page by page, in a folder that has the files it names; every verb of ./run and every script that they
name is there. What serves (live, view) is ended once it says that it does."""
import glob
import os
import re
import select
import shlex
import shutil
import subprocess
import sys
import tempfile

root, program = map(os.path.abspath, sys.argv[1:])
# Run elsewhere: models of a reader's own training by the tests of the laboratory, two formats by those
# of their readers, the job array by the test of its recipe.
kElsewhere = ['grumpy', 'amass/', '05_10', 'SLURM_']
kHasPage = os.path.exists(os.path.join(os.path.dirname(os.path.dirname(program)), 'web', 'index.html'))
kMotion = ('.bvh', '.glb', '.vrma')
failures = []
count = 0


def commands_of(text):
    """The lines of its code blocks, continued ones joined, without comments."""
    blocks = re.findall(r'^```(?:bash)?\n(.*?)^```', text, re.MULTILINE | re.DOTALL)
    blocks += re.findall(r'^    (\S.*)$', text, re.MULTILINE)
    lines = '\n'.join(blocks).replace('\\\n', ' ').split('\n')
    return [re.sub(r'\s+#.*', '', line).replace('build/release/panache', 'panache') for line in lines]


def run(arguments, folder):
    return subprocess.run([program, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300,
                          check=False)


def supply(path, folder):
    """Makes an input that is not there: motion, a folder of it, or a model."""
    whole = os.path.join(folder, path)
    os.makedirs(os.path.dirname(whole), exist_ok=True)
    if path.endswith('.safetensors'):
        shutil.copy(os.path.join(root, 'models', 'panache-int8.safetensors'), whole)
    elif path.endswith(kMotion):
        is_styled = re.search('lumbering|hunched|old|clip', os.path.basename(path))
        walk = os.path.join(folder, '.walk.bvh')
        run(['walker', '--seconds', '6', '--force', '-o', '.walk.bvh'], folder)
        if is_styled:
            run(['stylize', '.walk.bvh', '--style', 'old=1', '--force', '-o', '.old.bvh'], folder)
            shutil.move(os.path.join(folder, '.old.bvh'), walk)
        # The extension of the name decides; the name of its motion comes from the file.
        plain = os.path.join(folder, '.made', 'walk.bvh')
        os.makedirs(os.path.dirname(plain), exist_ok=True)
        shutil.move(walk, plain)
        run(['convert', '.made/walk.bvh', '--force', '-o', path], folder)


def supply_all(arguments, folder):
    outputs = {'-o', '--output', '--into', '--extract', '--report', '--name', '--style'}
    for before, argument in zip([''] + arguments, arguments):
        if before in outputs or argument.startswith('-'):
            continue
        if argument.endswith('/') or '*' in argument:
            if not glob.glob(os.path.join(folder, argument), recursive=True):
                supply(argument.split('/')[0] + '/one.' +
                       ('safetensors' if argument == 'library/' else 'bvh'), folder)
                if argument == 'library/':
                    os.remove(os.path.join(folder, 'library/one.safetensors'))
                    run(['styles', os.path.join(root, 'models/panache-int8.safetensors'), '--extract', 'old',
                         '-o', 'library/lumbering.safetensors'], folder)
        elif argument.endswith(kMotion + ('.safetensors',)) and not os.path.exists(
                os.path.join(folder, argument)):
            supply(argument, folder)


def serves(arguments, folder):
    """Whether it says where it listens; it is ended then."""
    arguments = arguments + ['--no-open'] if arguments[0] == 'view' else arguments
    process = subprocess.Popen([program, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    ready = select.select([process.stdout], [], [], 60)[0]
    line = process.stdout.readline() if ready else ''
    process.terminate()
    process.communicate(timeout=60)
    return line if re.search(r'open this address|relaying', line) is None else None


def check(page, line, folder):
    global count
    if line.startswith('./run '):
        verbs = subprocess.run([os.path.join(root, 'run'), 'help'], stdout=subprocess.PIPE, text=True,
                               check=True).stdout
        if re.search(rf'^  {line.split()[1]} ', verbs, re.MULTILINE) is None:
            failures.append(f'{page}: ./run has no verb for: {line}')
    elif line.startswith('scripts/'):
        if not os.access(os.path.join(root, line.split()[0]), os.X_OK):
            failures.append(f'{page}: no such script: {line}')
    elif line.startswith('find '):
        subprocess.run(line, shell=True, cwd=folder, check=True)
    elif line.startswith('panache ') and not any(name in line for name in kElsewhere):
        arguments = shlex.split(line.replace('../../samples', os.path.join(root, 'samples')))[1:]
        supply_all(arguments, folder)
        if arguments[0] == 'view' and not kHasPage:
            return
        count += 1
        if arguments[0] in ('live', 'view'):
            if arguments[:2] == ['live', 'send']:
                arguments = [a for a in arguments if a != '--loop'] + ['--seconds', '0.2']
            else:
                said = serves(arguments, folder)
                if said is not None:
                    failures.append(f'{page}: {line}: says "{said}"')
                return
        done = run(arguments, folder)
        if done.returncode != 0:
            failures.append(f'{page}: {line}: exit code {done.returncode}: {done.stdout}')


pages = ['README.md', 'CONTRIBUTING.md', 'models/README.md']
pages += sorted(os.path.relpath(path, root) for path in glob.glob(os.path.join(root, 'docs', '*.md')))
for page in pages:
    with open(os.path.join(root, page), encoding='utf-8') as file:
        lines = commands_of(file.read())
    with tempfile.TemporaryDirectory() as folder:
        if any('list.txt' in line for line in lines):
            supply('takes/one.bvh', folder)
        for line in lines:
            check(page, line.strip(), folder)
print(f'{count} commands on {len(pages)} pages')
sys.exit('\n'.join(failures) if failures or count < 30 else 0)
