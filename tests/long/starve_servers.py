#!/usr/bin/env python3
"""starve_servers.py PROGRAM MODEL STEPS: runs panache live and panache view where something is missing.

- Memory: STEPS amounts from the least with which the program starts to the least that is enough.
- Open files: as many as the program needs to start, and up to four more.
- Threads: none can be started.
- Room on the disk, for the recording: STEPS amounts from nothing to all of it.

Ends with 1 and a message where a program is ended by a signal, hangs, ends without a message, leaves
a recording that is not whole, or serves a file that is not the file."""
import http.client
import os
import re
import resource
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time

import starve
from starve import Failure, least

kSeconds = 300
kPatience = 3  # Of who asks for the page.
kLocal = '127.0.0.1'


def start(program, arguments, limits, user=None):
    def prepare():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        for what, most in limits:
            resource.setrlimit(what, (most, most))
        if user is not None and os.geteuid() == 0:
            os.setuid(user)
    environment = {**os.environ, 'PANACHE_MODEL': 'model.safetensors'}
    program.runs += 1
    return subprocess.Popen([program.path, *arguments], cwd=program.work, env=environment,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, preexec_fn=prepare)


def first_line(process, stream):
    """The first line that it says there, or b'' where it has ended or says nothing."""
    if not select.select([stream], [], [], kSeconds)[0]:
        return b''
    return stream.readline()


def finish(process, what, said=b''):
    """Its exit code; fails where it was ended by a signal, hangs or says nothing of a failure."""
    try:
        said += b''.join(process.communicate(timeout=kSeconds))
    except subprocess.TimeoutExpired:
        process.kill()
        raise Failure(f'{what}: hangs') from None
    what = f'{what}: exit code {process.returncode}, {said.decode(errors="replace")!r}'
    if process.returncode == 127 and b'while loading shared libraries' in said:
        return 1
    if process.returncode not in (0, 1) or (process.returncode == 1 and b'panache: ' not in said):
        raise Failure(what)
    return process.returncode


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind((kLocal, 0))
        return free.getsockname()[1]


def live(program, limits=(), user=None):
    """Whether the relay relays and records a walk."""
    program.fresh()
    starve.give_to_other(program.work)
    what = f'panache live, {limits}'
    port, avatar = free_port(), free_port()
    process = start(program, ['live', '--vmc-in', f'{kLocal}:{port}', '--vmc-out', f'{kLocal}:{avatar}',
                              '--style', 'old=1', '--record', 'out.bvh'], limits, user)
    said = first_line(process, process.stderr)
    if b'relaying' in said:
        subprocess.run([program.path, 'live', 'send', 'walk.bvh', '--to', f'{kLocal}:{port}', '--fps', '60',
                        '--seconds', '1.3'], cwd=program.work, check=True, stdout=subprocess.DEVNULL)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
    done = finish(process, what, said) == 0
    left = starve.contents(program.work)
    recorded = left.pop('out.bvh', None)
    if set(left) != set(program.inputs):
        raise Failure(f'{what}: leaves {sorted(left)}')
    if recorded is not None:
        read = program.start(['info', 'out.bvh'], program.work)
        frames = int(re.search(rb'Frames: (\d+)', recorded).group(1))
        if read.returncode != 0 or len(recorded.strip().splitlines()[-frames:]) != frames:
            raise Failure(f'{what}: the recording is not whole')
    if done != (recorded is not None):
        raise Failure(f'{what}: the exit code is not that of a recording')
    return done


def view(program, limits=(), user=None):
    """Whether the page and the motion are served."""
    program.fresh()
    what = f'panache view, {limits}'
    process = start(program, ['view', '--no-open', 'walk.glb'], limits, user)
    line = first_line(process, process.stdout)
    served = 0
    if port := re.match(rb'http://127\.0\.0\.1:(\d+)/', line):
        for path, wanted in program.served.items():
            try:
                connection = http.client.HTTPConnection(kLocal, int(port.group(1)), timeout=kPatience)
                connection.request('GET', path)
                answer = connection.getresponse()
                body = answer.read()
                if answer.status == 200 and body != wanted:
                    raise Failure(f'{what}: {path} is not what it should be')
                served += answer.status == 200
            except (http.client.HTTPException, OSError):
                pass  # Where it cannot even open the connection, nothing comes.
        time.sleep(0.05)
        if process.poll() is None:
            process.terminate()
            process.communicate(timeout=kSeconds)
            return served == len(program.served)
    finish(process, what, line)
    return False


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    path, model, steps = sys.argv[1], sys.argv[2], int(sys.argv[3])
    for verb in ('live', 'view'):
        if b'not in this build' in subprocess.run([path, verb, '--help'], stdout=subprocess.PIPE,
                                                  check=False).stdout:
            sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, 'bin'))
        program = starve.Program(path, model, os.path.join(folder, 'bin'))
        os.chmod(folder, 0o755)
        os.mkdir(os.path.join(folder, 'web'))
        program.served = {'/open/walk.glb': program.inputs['walk.glb']}
        for name, size in (('index.html', 1000), ('page.wasm', 1_000_000)):
            program.served['/' + name] = os.urandom(size)
            with open(os.path.join(folder, 'web', name), 'wb') as file:
                file.write(program.served['/' + name])
        program.least_memory += 1 << 19  # What the libraries need differs a little from run to run.
        failed = dict.fromkeys(['memory', 'files', 'room', 'threads'], 0)
        for server in (live, view):
            if not server(program):
                raise Failure(f'panache {server.__name__}: fails with all that it needs')
            # Beyond what the program starts with.
            enough = least(lambda more: server(program, [(resource.RLIMIT_AS, program.least_memory + more)]),
                           1 << 30, 1 << 20)
            for i in range(steps):
                limits = [(resource.RLIMIT_AS, program.least_memory + enough * i // steps)]
                failed['memory'] += not server(program, limits)
            for most in range(program.least_files, program.least_files + 5):
                failed['files'] += not server(program, [(resource.RLIMIT_NOFILE, most)])
            failed['threads'] += not server(program, [(resource.RLIMIT_NPROC, 1)], starve.kOther)
        for i in range(steps):
            failed['room'] += not live(program, [(resource.RLIMIT_FSIZE, 30_000 * i // steps)])
        print(f'{program.runs} runs; lacked: {failed}')


try:
    main()
except Failure as failure:
    sys.exit(f'starve_servers: {failure}')
