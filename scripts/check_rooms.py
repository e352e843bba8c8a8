#!/usr/bin/python3
"""Holds the includes against the order of the rooms: data flows one way.

usage: check_rooms.py

A file may include its own room and those above it in ROOMS. Public headers include public headers only, and a
public header belongs to the room in which its implementation stands. Prints one line for each include that runs
against this; exits 1 if there is one.
"""
import os
import re
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# From the lowest to the highest. 'paper2017' and 'multiview' are two methods that know nothing of each other.
ROOMS = ['core/base', 'core/light_field', 'core/preprocess', 'core/paper2017', 'core/multiview/search',
         'core/multiview/refine', 'core/multiview/maps', 'core/multiview', 'core/cloud', 'core/pipeline', 'evaluation',
         'io', 'ros', 'nodelets', 'tools']
STRANGERS = [('core/paper2017', 'core/multiview'), ('core/multiview', 'core/paper2017'), ('ros', 'io')]
# Public headers that have no source of their own name.
HEADER_ROOMS = {'core/cancellation': 'core/base', 'core/enum_names': 'core/base', 'core/error': 'core/base',
                'core/estimator': 'core/light_field', 'core/misfits': 'core/light_field',
                'core/multiview_options': 'core/multiview',
                'core/paper2017_options': 'core/paper2017', 'core/options_visitor': 'core/pipeline'}


def tracked_files():
    listing = subprocess.check_output(['git', '-C', TOP, 'ls-files', '--cached', '--others', '--exclude-standard', 'src',
                                       'include'], text=True)
    return [path for path in listing.split() if path.endswith(('.h', '.cpp')) and os.path.exists(os.path.join(TOP, path))]


def public_rooms(files):
    """The room of each public header, by its path below include/light_field_depth/ without the ending."""
    rooms = dict(HEADER_ROOMS)
    for path in files:
        if path.startswith('src/') and path.endswith('.cpp'):
            room = os.path.dirname(path[len('src/'):])
            name = os.path.splitext(os.path.basename(path))[0]
            rooms.setdefault(f'{room.split("/")[0]}/{name}', room)
    return rooms


def room_of(path, rooms):
    if path.startswith('include/light_field_depth/'):
        return rooms.get(os.path.splitext(path[len('include/light_field_depth/'):])[0])
    return os.path.dirname(path[len('src/'):])


def is_stranger(user, used):
    return any((user + '/').startswith(a + '/') and (used + '/').startswith(b + '/') for a, b in STRANGERS)


def main():
    files = tracked_files()
    rooms = public_rooms(files)
    findings = []
    for path in files:
        room = room_of(path, rooms)
        if room not in ROOMS:
            findings.append(f'{path}: there is no room "{room}"; give the header a source of its name or an entry here')
            continue
        for spelling in re.findall(r'^#include "([^"]+)"', open(os.path.join(TOP, path)).read(), re.M):
            is_public = spelling.startswith('light_field_depth/')
            target = ('include/' if is_public else 'src/') + spelling
            if target not in files:
                if is_public and '/' not in spelling[len('light_field_depth/'):]:
                    continue  # made from msg/ and config/
                findings.append(f'{path}: "{spelling}" is no header of this package by its path in src/ or include/')
                continue
            if path.startswith('include/') and not is_public:
                findings.append(f'{path}: a public header includes the internal {spelling}')
            used = room_of(target, rooms)
            if used not in ROOMS:
                continue
            if ROOMS.index(used) > ROOMS.index(room) or is_stranger(room, used):
                findings.append(f'{path}: the room {room} includes {spelling} of {used}')
            if not is_public and used.split('/')[0] != room.split('/')[0]:
                findings.append(f'{path}: includes the internal {spelling} of another library; make it public or move it')
    print('\n'.join(findings) if findings else f'rooms: {len(files)} files, no include runs back')
    return 1 if findings else 0


if __name__ == '__main__':
    sys.exit(main())
