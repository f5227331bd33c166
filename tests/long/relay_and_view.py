#!/usr/bin/env python3
"""relay_and_view.py PROGRAM MODEL SECONDS [PAGE]: runs panache live and panache view side by side.

Three senders play a walk to the relay through this script, which loses, doubles and reorders
datagrams and adds forged ones: damaged copies from the same address, noise, and bones and commands
from ever new addresses. Meanwhile the page (the folder PAGE, or a small one) is loaded again and
again, with broken and rejected requests in between. Ends with 1 and a message where
- a datagram that was passed to the relay neither arrives nor is counted as lost, one arrives that
  was never sent, or a bone of an intact datagram is not finite,
- a file of the page or the motion does not arrive as it is on the disk, or another host gets it,
- a program ends early, or between a quarter of the time and its end its memory grows by more than
  kGrowth (and, in the server, the largest file for each thread, which keeps its memory) or its open
  files become more."""
import json
import math
import os
import random
import re
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

kSenders = 3
kFps = 60
kLost = kDoubled = kReordered = kForged = 0.05  # Shares of the datagrams.
kLoads = 1  # Page loads a second, at most.
kGrowth = 2 << 20  # Bytes. 16 bytes a datagram would be 10 MB in half an hour.
kThreads = max(8, (os.cpu_count() or 1) - 1)  # Of cpp-httplib's server.
kLocal = '127.0.0.1'


class Failure(Exception):
    pass


def require(good, what):
    if not good:
        raise Failure(what)


def resident(process):
    with open(f'/proc/{process.pid}/statm', encoding='ascii') as file:
        return int(file.read().split()[1]) * os.sysconf('SC_PAGE_SIZE')


def open_files(process):
    return len(os.listdir(f'/proc/{process.pid}/fd'))


def udp():
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
    out.bind((kLocal, 0))
    return out


def padded(text):
    return text + b'\0' * (4 - len(text) % 4)


def bone(name, numbers):
    return padded(b'/VMC/Ext/Bone/Pos') + padded(b',sfffffff') + padded(name) + struct.pack('>7f', *numbers)


def bundle(messages, serial=0):
    return b'#bundle\0' + struct.pack('>Q', serial) + b''.join(
        struct.pack('>I', len(message)) + message for message in messages)


class Relay:
    """The senders, what happens to their datagrams on the way, and the avatar."""

    def __init__(self, program, model, folder, seconds, chance):
        self.chance = chance
        walk = os.path.join(folder, 'walk.bvh')
        subprocess.run([program, 'walker', '-o', walk, '--seconds', '6', '--fps', str(kFps)], check=True,
                       stdout=subprocess.DEVNULL)
        self.avatar = udp()
        free = udp()
        self.to = free.getsockname()
        free.close()
        self.process = subprocess.Popen(
            [program, 'live', '--model', model, '--vmc-in', f'{kLocal}:{self.to[1]}', '--vmc-out',
             f'{kLocal}:{self.avatar.getsockname()[1]}', '--style', 'old=1', '--max-lag', '1.5', '--skip-cycles',
             '--quiet'], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        time.sleep(0.5)
        self.inputs = [udp() for _ in range(kSenders)]
        self.links = [udp() for _ in range(kSenders)]  # The addresses that the relay sees.
        self.players = [subprocess.Popen(
            [program, 'live', 'send', walk, '--to', str(link.getsockname()[1]), '--fps', str(kFps), '--loop', '--seconds',
             str(seconds)], stdout=subprocess.DEVNULL) for link in self.inputs]
        self.serial = 0
        self.waiting = {}  # How often a serial has still to arrive.
        self.counts = dict.fromkeys(['passed', 'lost', 'doubled', 'reordered', 'forged', 'arrived'], 0)
        self.held = [None] * kSenders

    def forge(self, link, datagram):
        """One of the things that nobody should send."""
        self.counts['forged'] += 1
        kind = self.chance.randrange(4)
        number = [0, 1e30, math.nan, math.inf, -math.inf][self.chance.randrange(5)]
        if kind == 0:  # As if from the sender, damaged; not in the time tag, which tells it apart.
            damaged = bytearray(datagram[:8] + bytes(8) + datagram[16:])
            for _ in range(self.chance.randrange(1, 9)):
                damaged[self.chance.randrange(16, len(damaged))] = self.chance.randrange(256)
            link.sendto(damaged[:self.chance.randrange(1, len(damaged) + 1)], self.to)
        elif kind == 1:
            link.sendto(self.chance.randbytes(self.chance.randrange(1400)), self.to)
        elif kind == 2:  # As if from the sender: a bone that is no number.
            link.sendto(bundle([bone(b'Head', [number] * 7)]), self.to)
        else:
            with udp() as stranger:  # From a new address.
                stranger.sendto(bundle([bone(b'Hips', [number] * 7), bone(b'Head', [0] * 6 + [1])]), self.to)
                stranger.sendto(padded(b'/panache/style') + padded(b',sf') + padded(b'nobody') +
                                struct.pack('>f', number), self.to)

    def pass_on(self, link, datagram, copies=1):
        self.serial += 1
        tagged = datagram[:8] + struct.pack('>Q', self.serial) + datagram[16:]
        self.waiting[self.serial] = copies
        for _ in range(copies):
            link.sendto(tagged, self.to)
        self.counts['passed'] += copies

    def take(self, index):
        datagram, link = self.inputs[index].recv(1 << 16), self.links[index]
        require(datagram.startswith(b'#bundle\0'), 'a sender sends something else than bundles')
        what = self.chance.random()
        if what < kLost:
            self.counts['lost'] += 1
        elif what < kLost + kDoubled:
            self.counts['doubled'] += 1
            self.pass_on(link, datagram, 2)
        elif what < kLost + kDoubled + kReordered and self.held[index] is None:
            self.counts['reordered'] += 1
            self.held[index] = datagram
            return
        else:
            self.pass_on(link, datagram)
        if self.held[index] is not None:
            self.pass_on(link, self.held[index])
            self.held[index] = None
        if self.chance.random() < kForged:
            self.forge(link, datagram)

    def hear(self):
        datagram = self.avatar.recv(1 << 16)
        require(datagram.startswith((b'#bundle\0', b'/')), 'the avatar gets what is no OSC')
        if not datagram.startswith(b'#bundle\0') or len(datagram) < 16:
            return
        serial = struct.unpack('>Q', datagram[8:16])[0]
        if serial == 0:
            return  # Forged.
        require(self.waiting.get(serial), f'datagram {serial} arrives once more than it was sent')
        self.waiting[serial] -= 1
        if not self.waiting[serial]:
            del self.waiting[serial]
        self.counts['arrived'] += 1
        at = 16
        while at < len(datagram):
            size = struct.unpack('>I', datagram[at:at + 4])[0]
            message = datagram[at + 4:at + 4 + size]
            if message.startswith((b'/VMC/Ext/Bone/Pos\0', b'/VMC/Ext/Root/Pos\0')):
                require(all(map(math.isfinite, struct.unpack('>7f', message[-28:]))),
                        f'a bone in datagram {serial} is not finite')
            at += 4 + size

    def run_for(self, seconds):
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            for ready in select.select([self.avatar] + self.inputs, [], [], left)[0]:
                if ready is self.avatar:
                    self.hear()
                else:
                    self.take(self.inputs.index(ready))

    def end(self):
        """What the relay says at its end."""
        for player in self.players:
            player.kill()
            player.wait()
        self.run_for(0.5)
        self.process.send_signal(signal.SIGINT)
        summary = self.process.communicate(timeout=300)[0].strip()
        require(self.process.returncode == 0, f'panache live ends with {self.process.returncode}')
        self.avatar.settimeout(0.2)
        try:
            while True:
                self.hear()
        except socket.timeout:
            pass
        lost = int(re.search(r' (\d+) lost', summary).group(1))
        missing = sum(self.waiting.values())
        require(missing <= lost, f'{missing} datagrams did not arrive, {lost} were counted as lost')
        require(self.counts['arrived'] > 0, 'nothing arrives')
        return summary


class Page(threading.Thread):
    """panache view, and a browser's requests to it."""

    def __init__(self, program, folder, page, chance):
        super().__init__(daemon=True)
        self.chance = chance
        os.makedirs(os.path.join(folder, 'bin'))
        copy = shutil.copy(program, os.path.join(folder, 'bin/panache'))
        web = os.path.join(folder, 'web')
        if page:
            shutil.copytree(page, web)
        else:
            os.mkdir(web)
            for name, size in (('index.html', 1000), ('page.js', 50_000), ('page.wasm', 100_000)):
                with open(os.path.join(web, name), 'wb') as file:
                    file.write(chance.randbytes(size))
        self.files = {'/open/walk.bvh': os.path.join(folder, 'walk.bvh')}
        for inner, _, names in os.walk(web):
            for name in names:
                path = os.path.join(inner, name)
                if not path.endswith('.gz'):  # Sent as the file without this extension.
                    self.files['/' + os.path.relpath(path, web)] = path
        self.files['/'] = os.path.join(web, 'index.html')
        self.largest = max(map(os.path.getsize, self.files.values()))
        self.process = subprocess.Popen([copy, 'view', '--no-open', os.path.join(folder, 'walk.bvh')], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self.port = int(re.match(r'http://127\.0\.0\.1:(\d+)/', self.process.stdout.readline()).group(1))
        self.counts = dict.fromkeys(['loads', 'files', 'bytes', 'rejected', 'broken'], 0)
        self.failure = None
        self.stopped = threading.Event()
        self.paused = threading.Lock()

    def ask(self, question):
        with socket.create_connection((kLocal, self.port), timeout=300) as connection:
            connection.sendall(question)
            answer = b''
            while block := connection.recv(1 << 16):
                answer += block
        return answer

    def get(self, path, host=None):
        host = host or f'{kLocal}:{self.port}'
        head, _, body = self.ask(f'GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n'.encode()).partition(b'\r\n\r\n')
        return head.split(b' ')[1], body

    def load(self):
        for path, name in self.files.items():
            status, body = self.get(path)
            with open(name, 'rb') as file:
                require(status == b'200' and body == file.read(), f'{path} arrives as another file')
            self.counts['files'] += 1
            self.counts['bytes'] += len(body)
        self.counts['loads'] += 1
        status, body = self.get('/', 'example.org')
        require(status == b'403' and not body, 'another host gets the page')
        self.counts['rejected'] += 1
        # A connection that ends in the middle: of the question, or of the answer.
        with socket.create_connection((kLocal, self.port), timeout=300) as connection:
            question = f'GET / HTTP/1.1\r\nHost: {kLocal}:{self.port}\r\n\r\n'.encode()
            connection.sendall(question[:self.chance.randrange(len(question) + 1)])
        self.counts['broken'] += 1

    def run(self):
        try:
            while not self.stopped.wait(1 / kLoads):
                with self.paused:
                    self.load()
        except (Failure, OSError, IndexError) as failure:
            self.failure = failure

    def end(self):
        self.stopped.set()
        self.join()
        require(not self.failure, f'panache view: {self.failure}')
        require(self.counts['loads'] > 0, 'no page was loaded')
        self.process.terminate()
        self.process.wait()


def measure(relay, page):
    """Memory and open files of both, while no page is being loaded."""
    with page.paused:
        relay.run_for(0.5)  # Until the server has closed the last connection.
        return {name: {'bytes': resident(process), 'files': open_files(process)}
                for name, process in (('live', relay.process), ('view', page.process))}


def run(program, model, seconds, page_folder):
    seed = 1
    with tempfile.TemporaryDirectory() as folder:
        relay = page = None
        try:
            relay = Relay(program, model, folder, seconds, random.Random(seed))
            page = Page(program, folder, page_folder, random.Random(seed))
            for _ in range(10):  # So that each of the server's threads has its memory.
                page.load()
            page.start()
            quarters = []
            for _ in range(4):
                relay.run_for(seconds / 4)
                quarters.append(measure(relay, page))
            require(relay.process.poll() is None, 'panache live has ended')
            page.end()
            summary = relay.end()
        finally:
            for process in ([relay.process] + relay.players if relay else []) + ([page.process] if page else []):
                if process.poll() is None:
                    process.kill()
                    process.wait()
    print(f'{seconds:g} s; live: {relay.counts}\n{summary}\nview: {page.counts}')
    for i, quarter in enumerate(quarters):
        print(f'after {i + 1}/4: {json.dumps(quarter)}')
    before, after = quarters[0], quarters[-1]
    for name in before:
        grown = after[name]['bytes'] - before[name]['bytes']
        limit = kGrowth + (kThreads * page.largest if name == 'view' else 0)
        require(grown <= limit, f'panache {name} has grown by {grown} bytes')
        require(after[name]['files'] <= before[name]['files'], f'panache {name} has more open files')


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit('usage: relay_and_view.py PROGRAM MODEL SECONDS [PAGE]')
    program, model = map(os.path.abspath, sys.argv[1:3])
    for verb in ('live', 'view'):
        if 'not in this build' in subprocess.run([program, verb, '--help'], capture_output=True, text=True,
                                                 check=False).stdout:
            sys.exit(77)
    try:
        run(program, model, float(sys.argv[3]), sys.argv[4] if len(sys.argv) == 5 else None)
    except Failure as failure:
        sys.exit(f'relay_and_view: {failure}')


main()
