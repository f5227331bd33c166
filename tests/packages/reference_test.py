"""reference_test.py PROGRAM FOLDER: the manual page and the completions in FOLDER, which the build
made of PROGRAM, have every command and option of --help, and the shells take them."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

program, folder = sys.argv[1:]
failures = []


def expect(holds, message):
    if not holds:
        failures.append(message)


def output(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, timeout=600, **more).stdout


def read(name):
    with open(os.path.join(folder, name), encoding='utf-8') as file:
        return file.read()


man = read('panache.1').replace('\\-', '-')
bash, zsh, fish = os.path.join(folder, 'panache'), read('_panache'), read('panache.fish')


def options_in_help(verb):
    """The names of the options that --help lists: '-o', '--output'."""
    text = output(program, *verb, '--help')
    lines = re.findall(r'^ +(-[^ ]+)', text, re.MULTILINE)
    return [name for line in lines for name in line.split(',') if name.startswith('-')]


PATH = os.path.dirname(program) + os.pathsep + os.environ['PATH']


def complete_in_bash(*words):
    """What bash offers for a command line of these words."""
    script = ('source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _panache\n'
              'printf "%s\\n" "${COMPREPLY[@]}"')
    return output('bash', '--norc', '-c', script, bash, *words,
                  env={**os.environ, 'PATH': PATH}).strip('\n').splitlines()


# Every command and option.
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
    of_bash = complete_in_bash('panache', *command, '-')
    label = f"'{verb}'" if command[1:] else verb
    start = f'\n    {label})\n' if verb else '\n    _describe command'
    of_zsh = re.split(r';;|return', zsh.partition(start)[2])[0]
    own = ''.join(f'; and not __fish_seen_subcommand_from {inner[-1]}' for inner in commands
                  if command and inner[:-1] == command)
    condition = f"'__fish_seen_subcommand_from {command[-1]}{own}'" if verb else '__fish_use_subcommand'
    of_fish = [line for line in fish.splitlines() if f'-n {condition} ' in line]
    if command[1:]:
        expect(command[-1:] == complete_in_bash('panache', *command[:-1], command[-1][:2]),
               f'bash: no {verb}')
        expect(f"'::command:({command[-1]})'" in zsh, f'zsh: no {verb}')
    elif verb:
        expect(verb in complete_in_bash('panache', ''), f'bash: no {verb}')
        expect(f"'{verb}:" in zsh, f'zsh: no {verb}')
    if verb:
        expect(f' -f -a {command[-1]} ' in fish, f'fish: no {verb}')
    for name in names:
        count += 1
        expect(f'\\fB{name}\\fR' in section, f'manual page, {verb}: no {name}')
        expect(name in of_bash, f'bash, {verb}: no {name}')
        expect(re.search(rf"'\*{name}[=+]?\[", of_zsh), f'zsh, {verb}: no {name}')
        flag = f' -l {name[2:]} ' if name.startswith('--') else f' -s {name[1:]} '
        expect(any(flag in line for line in of_fish), f'fish, {verb}: no {name}')
print(f'{count} options of {len(commands)} commands were compared')
expect(count > 100, f'only {count} options were compared')

# In the shells themselves.
expect(complete_in_bash('panache', 'styli') == ['stylize'], 'bash completes no command')
expect(complete_in_bash('panache', 'help', 'styli') == ['stylize'], 'bash completes no help')
expect(complete_in_bash('panache', 'live', 'send', 'se') == [], 'bash: live send has no commands')
expect(complete_in_bash('panache', 'stylize', '--no-t') == ['--no-timing'], 'bash: no option')
expect(complete_in_bash('panache', 'stylize', '-o', '--no-t') == [], 'bash: an option as a value')
expect(complete_in_bash('panache', 'stylize', '--region', 'le') == ['legs=', 'left_arm='],
       'bash completes no region')
expect(complete_in_bash('panache', 'stylize', '--style', 'str') == ['strutting=', r'strong\ man='],
       'bash completes no style')
expect(complete_in_bash('panache', 'live', 'send', '--to', '') == [], 'bash: an address as a format')
with tempfile.TemporaryDirectory() as home:
    clean = {'HOME': home, 'PATH': PATH, 'TERM': 'dumb', 'LC_ALL': 'C.UTF-8'}
    if shutil.which('fish'):
        line = f'source {folder}/panache.fish; complete -C "panache stylize --no-t"'
        offered = output('fish', '--no-config', '-c', line, env=clean)
        expect(offered.startswith('--no-timing\t'), f'fish offers {offered!r}')
        for words, wanted, other in (('live ', 'send\t', '--to'), ('live send --', '--to\t', '--vmc-in'),
                                     ('live --', '--vmc-in\t', '--to\t')):
            line = f'source {folder}/panache.fish; complete -C "panache {words}"'
            offered = output('fish', '--no-config', '-c', line, env=clean)
            expect(wanted in offered and other not in offered, f'{words}: fish offers {offered!r}')
        for words, wanted in (('stylize --loop ', ['auto', 'off', 'on']),
                              ('stylize --style str', ['strong man', 'strutting'])):
            line = f'source {folder}/panache.fish; complete -C "panache {words}"'
            offered = output('fish', '--no-config', '-c', line, env=clean).splitlines()
            expect(sorted(word.split('\t')[0] for word in offered) == wanted,
                   f'{words}: fish offers {offered}')
    else:
        print('not run: there is no fish')
    if shutil.which('zsh'):
        script = os.path.join(os.path.dirname(__file__), 'complete.zsh')
        offered = output('zsh', '-f', script, f'{folder}/_panache', 'panache stylize --no-t', env=clean)
        expect('--no-timing' in offered, f'zsh offers {offered!r}')
        for words, wanted in (('live se', 'send'), ('live send --lo', '--loop'),
                              ('stylize --up -', '-x'), ('stylize --style strut', 'strutting')):
            offered = output('zsh', '-f', script, f'{folder}/_panache', f'panache {words}', env=clean)
            expect(wanted in offered, f'{words}: zsh offers {offered!r}')
    else:
        print('not run: there is no zsh')
    if shutil.which('man') and shutil.which('groff'):
        shown = subprocess.run(['man', '--warnings', '-E', 'UTF-8', '-l', f'{folder}/panache.1'],
                               capture_output=True, text=True, env={**clean, 'MANWIDTH': '80'})
        expect(shown.stderr == '', f'man warns: {shown.stderr}')
        expect('panache stylize' in shown.stdout, 'man shows no command')
    else:
        print('not run: there is no man')

sys.exit('\n'.join(failures) or 0)
