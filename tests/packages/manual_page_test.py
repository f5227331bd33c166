"""manual_page_test.py PROGRAM PAGE: the manual page, which the build made of PROGRAM, has every command
and option of --help, and man takes it."""
import re
import shutil
import subprocess
import sys

program, page = sys.argv[1:]
failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=600).stdout


with open(page, encoding='utf-8') as file:
    man = file.read().replace('\\-', '-')


def options_in_help(verb):
    """The names of the options that --help lists: '-o', '--output'."""
    lines = re.findall(r'^ +(-[^ ]+)', output(program, *verb, '--help'), re.MULTILINE)
    return [name for line in lines for name in line.split(',') if name.startswith('-')]


def verbs_of(*verb):
    """The commands that the help of a command lists."""
    listed = output(program, *verb, '--help').partition('Subcommands:\n')[2].partition('\n\n')[0]
    return [[*verb, name] for name in re.findall(r'^  ([a-z]+)', listed, re.MULTILINE)]


commands = [command for verb in verbs_of() for command in (verb, *verbs_of(*verb))]
expect(5 <= len(verbs_of()) <= 10, f'--help lists {len(verbs_of())} commands')
expect(['live', 'send'] in commands, f'no command has a command of its own: {commands}')
count = 0
for command in [[], *commands]:
    verb = ' '.join(command)
    names = options_in_help(command)
    expect('--help' in names, f'{verb}: --help lists no options')
    start = f'.SS panache {verb}\n' if verb else '.SH OPTIONS\n'
    section = re.split(r'^\.S[HS]', man.partition(start)[2], flags=re.MULTILINE)[0]
    for name in names:
        count += 1
        expect(f'\\fB{name}\\fR' in section, f'{verb}: no {name}')
print(f'{count} options of {len(commands)} commands were compared')
expect(count > 100, f'only {count} options were compared')

if shutil.which('man') and shutil.which('groff'):
    shown = subprocess.run(['man', '--warnings', '-E', 'UTF-8', '-l', page], capture_output=True, text=True,
                           env={'PATH': '/usr/bin:/bin', 'TERM': 'dumb', 'LC_ALL': 'C.UTF-8', 'MANWIDTH': '80'})
    expect(shown.stderr == '', f'man warns: {shown.stderr}')
    expect('panache stylize' in shown.stdout, 'man shows no command')
else:
    print('not run: there is no man')

sys.exit('\n'.join(failures) or 0)
