#!/usr/bin/env python3
"""starve.py PROGRAM MODEL STEPS [FBX]: runs the verbs of panache where something is missing; with the
path of a motion as FBX, where the program reads that, too.

- Memory: from the least with which the program starts to what a verb needs, in steps of
  3 MB / STEPS.
- Open files: as many as the program needs to start, and up to four more.
- Room on the disk: from nothing to the largest output, in STEPS steps.
- Threads: none can be started. A folder nobody may write to.
- A folder that vanishes while its file is made; STEPS times each, inputs that are cut short or
  replaced while they are read, and names of any bytes.

Ends with 1 and a message where a run is ended by a signal or takes longer than kSeconds, or fails
without a message, or, unless its inputs change, leaves an output that is not whole or changes an
input."""
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

kSeconds = 600
kOther = 54321  # A user who may write where it is allowed to, as root may anywhere.
kVerbs = [
    ['info', 'walk.bvh'],
    ['info', 'walk.glb'],
    ['info', 'model.safetensors'],
    ['stylize', 'walk.bvh', '--style', 'old=1', '-o', 'out.bvh'],
    ['stylize', 'walk.glb', '--style', 'old=1..0', '-o', 'out.glb'],
    ['stylize', 'walk.bvh', 'slow.bvh', 'walk.glb', '--style', 'angry=1', '--jobs', '2', '-o',
     'out'],
    ['convert', 'walk.bvh', '-o', 'out.glb'],
    ['convert', 'walk.glb', '-o', 'out.bvh'],
    ['retarget', 'slow.bvh', '--onto', 'walk.glb', '-o', 'out.glb'],
    ['learn', 'walk.bvh', 'slow.bvh', '--name', 'slow', '--into', 'out.safetensors'],
    ['learn', 'walk.bvh', 'slow.bvh', '--name', 'slower', '--into', 'mine.safetensors', '--force'],
    ['styles', 'mine.safetensors', '--extract', 'slow', '-o', 'out.safetensors'],
    ['walker', '--speed', '1.5', '-o', 'out.bvh'],
]

kFbxVerbs = [
    ['info', 'walk.fbx'],
    ['convert', 'walk.fbx', '-o', 'out.glb'],
    ['stylize', 'walk.fbx', '--style', 'old=1', '-o', 'out.glb'],
]
# Meshes of FBX are read by a process of its own, and so not at all where none can be started.
kNeedsProcess = '.fbx'


class Failure(Exception):
    pass


def contents(folder):
    found = {}
    for where, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(where, name)
            with open(path, 'rb') as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


def least(enough, most, step):
    """The least number that is enough, at most `step` too large."""
    fewest = 0
    while most - fewest > step:
        middle = (fewest + most) // 2
        fewest, most = (fewest, middle) if enough(middle) else (middle, most)
    return most


class Program:
    """The program, and the folder that each run starts with a copy of. What is in that, `maker` makes,
    or else the program."""

    def __init__(self, path, model, folder, fbx=None, maker=None):
        self.folder = folder
        os.chmod(folder, 0o755)
        self.path = shutil.copy(maker or path, os.path.join(folder, 'panache'))
        os.mkdir(os.path.join(folder, 'models'))
        shutil.copy(os.path.join(os.path.dirname(model), 'walker.safetensors'),
                    os.path.join(folder, 'models'))
        self.made = os.path.join(folder, 'made')
        os.mkdir(self.made)
        shutil.copy(model, os.path.join(self.made, 'model.safetensors'))
        if fbx:
            shutil.copy(fbx, os.path.join(self.made, 'walk.fbx'))
        self.work = os.path.join(folder, 'work')
        for arguments in (['walker', '--seconds', '4', '-o', 'walk.bvh'],
                          ['walker', '--seconds', '5', '--speed', '0.7', '-o', 'slow.bvh'],
                          ['convert', 'walk.bvh', '-o', 'walk.glb'],
                          ['learn', 'walk.bvh', 'slow.bvh', '--name', 'slow', '--into',
                           'mine.safetensors']):
            done = self.start(arguments, cwd=self.made)
            if done.returncode != 0:
                raise Failure(f'{arguments}: {done.stderr.decode()}')
        if maker:
            self.path = shutil.copy(path, os.path.join(folder, 'panache-lab'))
        self.inputs = contents(self.made)
        self.runs = 0
        self.fresh()
        # With what the program starts; with less its libraries do not load.
        self.least_memory = least(lambda most: self.starts(resource.RLIMIT_AS, most), 1 << 31,
                                  1 << 16)
        self.least_files = least(lambda most: self.starts(resource.RLIMIT_NOFILE, most), 64, 1)

    def start(self, arguments, cwd, limits=(), user=None, stdin=subprocess.DEVNULL,
              seconds=kSeconds):
        def prepare():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # A full disk is an error, no signal.
            for what, most in limits:
                resource.setrlimit(what, (most, most))
            if user is not None and os.geteuid() == 0:
                os.setuid(user)
        environment = {**os.environ, 'PANACHE_MODEL': 'model.safetensors'}
        return subprocess.run([self.path, *arguments], cwd=cwd, env=environment, stdin=stdin,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=seconds,
                              preexec_fn=prepare, check=False)

    def starts(self, what, most):
        try:
            return self.start(['--version'], self.work, [(what, most)], seconds=10).returncode == 0
        except subprocess.TimeoutExpired:  # OpenBLAS waits for memory: see starve_training.py.
            return False

    def fresh(self):
        shutil.rmtree(self.work, ignore_errors=True)
        shutil.copytree(self.made, self.work)

    def run(self, arguments, **options):
        """What became of a run, and a description; fails where exit code or message is wrong."""
        self.runs += 1
        try:
            done = self.start(arguments, self.work, **options)
        except subprocess.TimeoutExpired:
            raise Failure(f'panache {arguments}, {options}: takes more than {kSeconds} s') from None
        said = done.stderr.decode(errors='replace')
        what = f'panache {arguments}, {options}: exit code {done.returncode}, {said!r}'
        if done.returncode == 127 and 'while loading shared libraries' in said:
            return done, what  # What that needs differs a little from run to run.
        if done.returncode not in (0, 1):
            raise Failure(what)
        if done.returncode == 1 and os.path.basename(self.path) + ': ' not in said:
            raise Failure(what + ': no message')
        return done, what

    def compare(self, what, wanted, whole):
        """That what is in the folder is input, or output as it should be; all of it if `whole`."""
        left = contents(self.work)
        for name, content in left.items():
            if content != wanted.get(name) and content != self.inputs.get(name):
                raise Failure(f'{what}: {name} is not what it should be')
        missing = [name for name in (wanted if whole else self.inputs) if name not in left]
        if missing:
            raise Failure(f'{what}: {missing} are missing')
        if whole and any(left[name] != wanted[name] for name in wanted):
            raise Failure(f'{what}: an output was not written')

    def reference(self, arguments):
        self.fresh()
        done, what = self.run(arguments)
        if done.returncode != 0:
            raise Failure(what)
        return contents(self.work), done.stdout

    def starved(self, arguments, wanted, printed, **options):
        self.fresh()
        done, what = self.run(arguments, **options)
        self.compare(what, wanted, done.returncode == 0)
        if done.returncode == 0 and arguments[0] == 'info' and done.stdout != printed:
            raise Failure(f'{what}: printed something else')
        return done.returncode == 0


def starve_of_memory(program, verb, wanted, printed, steps):
    failed = successes = 0
    most = program.least_memory
    while successes < 3:  # In a row: what is enough differs a little from run to run.
        done = program.starved(verb, wanted, printed, limits=[(resource.RLIMIT_AS, most)])
        successes = successes + 1 if done else 0
        failed += not done
        most += max(1 << 12, (3 << 20) // steps)
    if not failed:
        raise Failure(f'panache {verb}: never lacked memory')
    return failed


def starve_of_files(program, verb, wanted, printed):
    failed = 0
    for most in range(program.least_files, program.least_files + 5):
        limits = [(resource.RLIMIT_NOFILE, most)]
        failed += not program.starved(verb, wanted, printed, limits=limits)
    return failed


def starve_of_room(program, verb, wanted, printed, steps):
    outputs = [content for name, content in wanted.items() if program.inputs.get(name) != content]
    largest = max(map(len, outputs), default=0)
    failed = 0
    for most in sorted({largest * i // steps for i in range(steps)}):
        failed += not program.starved(verb, wanted, printed, limits=[(resource.RLIMIT_FSIZE, most)])
    if largest and not failed:
        raise Failure(f'panache {verb}: never lacked room')
    return failed


def give_to_other(path):
    if os.geteuid() != 0:
        return
    os.chown(path, kOther, kOther)
    for where, folders, names in os.walk(path):
        for name in folders + names:
            os.chown(os.path.join(where, name), kOther, kOther)


def without_threads(program, verb, wanted, printed):
    program.fresh()
    give_to_other(program.work)
    done, what = program.run(verb, user=kOther, limits=[(resource.RLIMIT_NPROC, 1)])
    needs_process = 'out.glb' in verb and any(word.endswith(kNeedsProcess) for word in verb)
    if done.returncode != needs_process:
        raise Failure(what)
    program.compare(what, wanted, done.returncode == 0)


def without_leave(program, verb, wanted):
    program.fresh()
    os.chmod(program.work, 0o555)
    for name in os.listdir(program.work):
        os.chmod(os.path.join(program.work, name), 0o444)
    done, what = program.run(verb, user=kOther)
    writes = any(program.inputs.get(name) != content for name, content in wanted.items())
    if (done.returncode == 1) != writes:
        raise Failure(what)
    os.chmod(program.work, 0o755)
    program.compare(what, wanted, False)


def vanishing_folder(program):
    """The folder of the output is removed while the input, a pipe, is still open."""
    program.fresh()
    target = os.path.join(program.work, 'folder')
    os.mkdir(target)
    ours, theirs = os.pipe()

    def feed():
        motion = program.inputs['walk.bvh']
        with os.fdopen(theirs, 'wb') as pipe:
            pipe.write(motion[:len(motion) // 2])
            pipe.flush()
            time.sleep(0.3)
            shutil.rmtree(target)
            pipe.write(motion[len(motion) // 2:])
    feeder = threading.Thread(target=feed)
    feeder.start()
    with os.fdopen(ours, 'rb') as pipe:
        done, what = program.run(['stylize', '-', '--style', 'old=1', '-o', 'folder/out.bvh'],
                                 stdin=pipe)
    feeder.join()
    left = contents(program.work)
    if done.returncode == 0 and len(left.get('folder/out.bvh', b'')) < 1000:
        raise Failure(what + ': nothing was written')
    for name in left:
        if name.endswith('.part') or (done.returncode == 1 and name.startswith('folder')):
            raise Failure(f'{what}: left {name}')


def changing_inputs(program, count, draw):
    """Files that another process cuts short, lengthens and replaces while they are read."""
    for name in ('walk.bvh', 'walk.glb', 'model.safetensors'):
        program.fresh()
        whole = program.inputs[name]
        path = os.path.join(program.work, name)
        over = threading.Event()

        def change():
            while not over.is_set():
                with open(path, 'r+b') as file:
                    file.truncate(draw.randrange(len(whole)))
                    file.seek(draw.randrange(len(whole)))
                    file.write(whole[:draw.randrange(len(whole))])
                    file.seek(0)
                    file.write(whole)
                    file.truncate(len(whole))
                if draw.random() < 0.2:
                    os.replace(shutil.copy(path, path + '.new'), path)
                time.sleep(draw.random() * 0.01)
        other = threading.Thread(target=change)
        other.start()
        try:
            motion = name if name != 'model.safetensors' else 'slow.bvh'
            for _ in range(count):
                program.run(['stylize', motion, '--style', 'old=1', '--force', '-o',
                             'out' + os.path.splitext(motion)[1]])
        finally:
            over.set()
            other.join()


def any_names(program, count, draw):
    """Motion and outputs whose names are any bytes that a name may have."""
    program.fresh()
    allowed = bytes(byte for byte in range(1, 256) if byte != ord('/'))
    for _ in range(count):
        length = draw.choice((1, 3, 20, 200))
        name = b'n' + bytes(draw.choices(allowed, k=length))
        path = os.path.join(os.fsencode(program.work), name + b'.bvh')
        with open(path, 'wb') as file:
            file.write(program.inputs['walk.bvh'])
        out = b'o' + name + b'.bvh'
        done, what = program.run([b'stylize', name + b'.bvh', b'--style', b'old=1', b'-o', out])
        if done.returncode != 0:
            raise Failure(what)
        with open(os.path.join(os.fsencode(program.work), out), 'rb') as file:
            if not file.read().startswith(b'HIERARCHY'):
                raise Failure(what)
        done, what = program.run([b'info', name + b'.bvh', b'--json'])
        if done.returncode != 0:
            raise Failure(what)
        os.remove(path)
        os.remove(os.path.join(os.fsencode(program.work), out))


def skip_without_other():
    if os.geteuid() == 0:
        try:
            subprocess.run(['true'], preexec_fn=lambda: os.setuid(kOther), check=True)
        except (OSError, subprocess.SubprocessError):
            print('starve: not run: root cannot become another user here')
            sys.exit(77)


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    path, model, steps = sys.argv[1], sys.argv[2], int(sys.argv[3])
    fbx = sys.argv[4] if len(sys.argv) == 5 else None
    skip_without_other()
    draw = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        program = Program(path, model, folder, fbx)
        verbs = kVerbs + (kFbxVerbs if fbx else [])
        memory = files = room = 0
        for verb in verbs:
            wanted, printed = program.reference(verb)
            memory += starve_of_memory(program, verb, wanted, printed, steps)
            files += starve_of_files(program, verb, wanted, printed)
            room += starve_of_room(program, verb, wanted, printed, steps)
            without_threads(program, verb, wanted, printed)
            without_leave(program, verb, wanted)
        vanishing_folder(program)
        changing_inputs(program, steps, draw)
        any_names(program, steps, draw)
        print(f'{len(verbs)} commands, {program.runs} runs; {memory} lacked memory, '
              f'{files} open files, {room} room on the disk')


if __name__ == '__main__':
    try:
        main()
    except Failure as failure:
        sys.exit(f'starve: {failure}')
