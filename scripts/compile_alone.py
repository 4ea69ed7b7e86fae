#!/usr/bin/env python3
"""Compiles every file of src by itself, syntax alone, warnings as errors: no headers precompiled, no other file before it.

The release preset compiles a room's files as one, where a missing include, or a name that hides another, may not show.
compile_alone.py [FOLDER]   where to configure (build/alone)
"""
import concurrent.futures
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def compiled(entry):
    command = entry['command'].split(' -o ')[0] + ' -fsyntax-only ' + entry['file']
    return subprocess.run(command, shell=True, cwd=entry['directory'], capture_output=True, text=True)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, 'build/alone')
    options = ['-DCMAKE_UNITY_BUILD=OFF', '-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON', '-DSCOTOPIC_BUILD_TESTS=OFF',
               '-DSCOTOPIC_WERROR=ON']
    subprocess.run(['cmake', '--preset', 'dev', '-B', folder, *options], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(folder, 'compile_commands.json')) as file:
        entries = [e for e in json.load(file) if e['file'].startswith(os.path.join(ROOT, 'src'))]
    if not entries:
        sys.exit('compile_alone.py: no files of src are compiled')
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = [result.stderr for result in pool.map(compiled, entries) if result.returncode != 0]
    print('\n'.join(failed), end='')
    print(f'{len(entries)} files of src compiled alone, {len(failed)} failed')
    sys.exit(bool(failed))


if __name__ == '__main__':
    main()
