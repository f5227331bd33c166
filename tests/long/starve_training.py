#!/usr/bin/env python3
"""starve_training.py LABORATORY PROGRAM MODEL STEPS: runs panache-lab train and panache-lab eval where
something is missing. PROGRAM makes the motion.

- Memory: STEPS amounts from the least with which the program starts to the least that is enough.
- Open files: as many as the program needs to start, and up to four more.
- Room on the disk: STEPS amounts from nothing to the largest output. A folder nobody may write to.

Ends with 1 and a message where a run is ended by a signal, hangs or fails without a message, or
leaves an output that is not whole. Training that failed is run again: it goes on from its
checkpoint, and its outputs must be those of a run that lacked nothing.

Not tried is what OpenBLAS does before main(): it starts a thread for each core but one, and ends the
program with SIGINT where it cannot; and the program does not end where these find no memory."""
import os
import resource
import sys
import tempfile

import starve
from starve import Failure, least

kManifest = '''path,style,content,take,neutral,split
walk.bvh,neutral,walk,1,1,train
slow.bvh,slow,walk,1,0,train
walk.bvh,neutral,walk,2,1,test
slow.bvh,slow,walk,2,0,test
'''
kVerbs = [
    ['train', 'walks.csv', '-o', 'out.safetensors', '--steps', '20'],
    ['eval', 'walks.csv', '--model', 'slow.safetensors'],
]
kBuffer = 130 << 20  # What each thread of OpenBLAS takes.


class Training(starve.Program):
    def starved(self, arguments, wanted, printed, **options):
        """As of other commands; training that failed goes on without limits."""
        self.fresh()
        done, what = self.run(arguments, **options)
        failed = done.returncode != 0
        if failed and arguments[0] == 'train':
            done, after = self.run(arguments)
            what += f', then {after}'
            if done.returncode != 0:
                raise Failure(what)
        self.compare(what, wanted, done.returncode == 0)
        return not failed


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    path, maker, model, steps = *sys.argv[1:4], int(sys.argv[4])
    starve.skip_without_other()
    with tempfile.TemporaryDirectory() as folder:
        program = Training(path, model, folder, maker=maker)
        with open(os.path.join(program.made, 'walks.csv'), 'w', encoding='utf8') as file:
            file.write(kManifest)
        program.fresh()
        model_of_walks = ['train', 'walks.csv', '-o', 'slow.safetensors', '--steps', '20']
        done, what = program.run(model_of_walks)
        if done.returncode != 0:
            raise Failure(what)
        os.rename(os.path.join(program.work, 'slow.safetensors'),
                  os.path.join(program.made, 'slow.safetensors'))
        program.inputs = starve.contents(program.made)
        program.least_memory += (os.cpu_count() or 1) * kBuffer
        memory = files = room = 0
        for verb in kVerbs:
            wanted, printed = program.reference(verb)

            def enough(most, verb=verb):
                program.fresh()
                return program.run(verb, limits=[(resource.RLIMIT_AS, most)])[0].returncode == 0
            needed = least(enough, 1 << 32, 1 << 28)
            for i in range(steps):
                most = program.least_memory + (needed - program.least_memory) * i // steps
                limits = [(resource.RLIMIT_AS, most)]
                memory += not program.starved(verb, wanted, printed, limits=limits)
            files += starve.starve_of_files(program, verb, wanted, printed)
            room += starve.starve_of_room(program, verb, wanted, printed, steps)
            starve.without_leave(program, verb, wanted)
        print(f'{len(kVerbs)} commands, {program.runs} runs; {memory} lacked memory, '
              f'{files} open files, {room} room on the disk')


if __name__ == '__main__':
    try:
        main()
    except Failure as failure:
        sys.exit(f'starve_training: {failure}')
