#!/usr/bin/python3
"""Holds docs/architecture.md against the tree.

usage: check_architecture.py

Every room of check_rooms.py has its section and no other has one; every file that the table of a room names is
there, and every source and header of the room is in its table; every path and every link of the documents exists.
Prints one line for each finding; exits 1 if there is one.
"""
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from check_rooms import ROOMS  # noqa: E402

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ARCHITECTURE = 'docs/architecture.md'
ENDINGS = ('.h', '.cpp')
# Where the paths and links of a document begin; what only a build or a run makes is left out.
FOLDERS = ('benchmark', 'cmake', 'config', 'data', 'docs', 'examples', 'include', 'launch', 'msg', 'scripts', 'src', 'test')


def read(path):
    with open(os.path.join(TOP, path), encoding='utf-8') as file:
        return file.read()


def tracked_files():
    listing = subprocess.check_output(['git', '-C', TOP, 'ls-files', '--cached', '--others', '--exclude-standard'], text=True)
    return {path for path in listing.splitlines() if os.path.exists(os.path.join(TOP, path))}


def stems_of(room, files):
    """The names of a room's files without endings; a plain twin goes with its kernels."""
    names = {os.path.basename(path) for path in files if os.path.dirname(path) == 'src/' + room and path.endswith(ENDINGS)}
    return {re.sub(r'_kernels_plain$', '_kernels', os.path.splitext(name)[0]) for name in names}


def check_rooms(text, files):
    sections = {title: body for title, body in re.findall(r'^### `([^`]+)`\n(.*?)(?=^##)', text, re.M | re.S)}
    for room in ROOMS:
        if room not in sections:
            yield f'has no section for the room {room}'
    for title, body in sections.items():
        if title not in ROOMS:
            yield f'has a section for {title}, which is no room'
            continue
        named = set()
        for row in re.findall(r'^\| (`.*?) \|', body, re.M):
            named.update(re.findall(r'`([^`]+)`', row))
        there = stems_of(title, files)
        for name in sorted(named - there):
            yield f'names {name} in the room {title}, where there is no such file'
        for name in sorted(there - named):
            yield f'does not name {name} of the room {title}'


def check_paths(document, text, files):
    folders = {path for file in files for path in parents(file)}
    for link in re.findall(r'\]\(([^)#]+)', text):
        if '://' not in link and os.path.normpath(os.path.join(os.path.dirname(document), link)) not in files | folders:
            yield f'the link {link} leads nowhere'
    for path in re.findall(r'`((?:' + '|'.join(FOLDERS) + r')/[\w./-]*)`', text):
        if path.rstrip('/') not in files | folders:
            yield f'names {path}, which is not there'


def parents(path):
    while path:
        path = os.path.dirname(path)
        if path:
            yield path


def main():
    files = tracked_files()
    findings = [f'{ARCHITECTURE}: {finding}' for finding in check_rooms(read(ARCHITECTURE), files)]
    documents = sorted(path for path in files if path.endswith('.md') and not path.startswith('benchmark/results/'))
    for document in documents:
        findings += [f'{document}: {finding}' for finding in check_paths(document, read(document), files)]
    print('\n'.join(findings) if findings else f'{ARCHITECTURE}: {len(ROOMS)} rooms; paths and links of {len(documents)} documents')
    return 1 if findings else 0


if __name__ == '__main__':
    sys.exit(main())
