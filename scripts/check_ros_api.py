#!/usr/bin/python3
"""Holds docs/ros_api.md against the code, both ways.

usage: check_ros_api.py [--write]

Every topic, service and private parameter that src/ros names must be in the document, and every one that the
document names must be in the code. The tables of the parameters of config/LightFieldDepth.cfg and of the arguments
of the launch files are made from these files; --write puts them into the document, else a table that is out of
date is a finding. Exits 1 if there is a finding.
"""
import os
import re
import sys
import types
import xml.etree.ElementTree

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DOCUMENT = os.path.join(TOP, 'docs', 'ros_api.md')
# What the code takes from libraries, or makes of a pattern.
OF_LIBRARIES = {'/diagnostics'}
OF_PATTERNS = {'view_<row>_<column>/image_rect_color', 'view_<row>_<column>/camera_info'}


def read(*path):
    with open(os.path.join(TOP, *path), encoding='utf-8') as file:
        return file.read()


def source_of(folder):
    """All of its C++ in one text, without comments, on one line."""
    names = sorted(name for name in os.listdir(os.path.join(TOP, folder)) if name.endswith(('.h', '.cpp')))
    text = '\n'.join(re.sub(r'//.*', '', read(folder, name)) for name in names)
    return re.sub(r'\s+', ' ', text)


def names_in_code():
    """The private names that the node advertises, and those of its parameters."""
    code = source_of('src/ros')
    advertised = re.findall(r'\badvertise(?:Image|Service|<[\w:]+>)\( ?(?:\w+, )?"([\w/]+)"', code)
    parameters = re.findall(r'\b(?:read|readInRange|getParam|param)(?:<\w+>)?\( ?(?:\w+, )?"(\w+)"', code)
    return {'~' + name for name in advertised}, {'~' + name for name in parameters}


def names_in_document(text, *titles):
    """What the items of these sections begin with."""
    names = set()
    for title in titles:
        section = re.search(r'^### ' + title + r'\n(.*?)(?=^##)', text, re.M | re.S)
        if section is None:
            sys.exit(f'{DOCUMENT}: there is no section "{title}"')
        for item in re.findall(r'^\* ((?:`[^`]+`(?:, )?)+)', section.group(1), re.M):
            names.update(re.findall(r'`([^`]+)`', item))
    return names


class Generator:
    """Stands in for dynamic_reconfigure's, which is not there without ROS."""

    def __init__(self):
        self.parameters = []

    def const(self, _name, _kind, value, _description):
        return value

    def enum(self, values, _description):
        return values

    def add_group(self, _name):
        return self

    def add(self, name, kind, _level, description, default, low=None, high=None, edit_method=None):
        self.parameters.append((name, kind, description, default, low, high, edit_method))

    def generate(self, *_names):
        return 0


def dynamic_parameters():
    generator = Generator()
    stand_in = types.ModuleType('parameter_generator_catkin')
    stand_in.ParameterGenerator = lambda: generator
    for kind in ('bool', 'double', 'int', 'str'):
        setattr(stand_in, kind + '_t', kind)
    sys.modules['dynamic_reconfigure'] = types.ModuleType('dynamic_reconfigure')
    sys.modules['dynamic_reconfigure.parameter_generator_catkin'] = stand_in
    try:
        exec(compile(read('config', 'LightFieldDepth.cfg'), 'LightFieldDepth.cfg', 'exec'), {'__name__': 'cfg'})
    except SystemExit:
        pass
    return generator.parameters


def value_text(value):
    return str(value).lower() if isinstance(value, bool) else f'{value:g}' if isinstance(value, float) else str(value)


def parameter_table():
    lines = ['| parameter | type, default | |', '|---|---|---|']
    for name, kind, description, default, low, high, choices in dynamic_parameters():
        limits = ', '.join(choices) if choices else '' if low is None else f'{value_text(low)} to {value_text(high)}'
        default_text = value_text(default) if default != '' else 'empty'
        lines.append(f'| `~{name}` | {kind}, {default_text} | {description}' + (f' ({limits})' if limits else '') + ' |')
    return '\n'.join(lines)


def launch_tables():
    tables = []
    for name in sorted(os.listdir(os.path.join(TOP, 'launch'))):
        if not name.endswith('.launch'):
            continue
        lines = [f'`{name}`', '', '| argument | default | |', '|---|---|---|']
        for argument in xml.etree.ElementTree.fromstring(read('launch', name)).findall('arg'):
            if argument.get('value') is not None:
                continue
            default = argument.get('default')
            default_text = 'required' if default is None else f'`{default}`' if default else 'empty'
            lines.append(f'| `{argument.get("name")}` | {default_text} | {argument.get("doc", "")} |')
        tables.append('\n'.join(lines))
    return '\n\n'.join(tables)


def with_tables(text):
    for place, table in (('config/LightFieldDepth.cfg', parameter_table()), ('launch', launch_tables())):
        pattern = re.compile(rf'(<!-- {re.escape(place)} -->\n).*?(<!-- end of table -->\n)', re.S)
        if not pattern.search(text):
            sys.exit(f'{DOCUMENT}: there is no place for the table of {place}')
        text = pattern.sub(lambda match, table=table: f'{match.group(1)}\n{table}\n\n{match.group(2)}', text)
    return text


def differences(what, in_code, in_document):
    return ([f'docs/ros_api.md: does not have the {what} {name}, which src/ros has' for name in sorted(in_code - in_document)] +
            [f'docs/ros_api.md: has the {what} {name}, which src/ros does not' for name in sorted(in_document - in_code)])


def main():
    with open(DOCUMENT, encoding='utf-8') as file:
        text = file.read()
    current = with_tables(text)
    if '--write' in sys.argv[1:] and current != text:
        with open(DOCUMENT, 'w', encoding='utf-8') as file:
            file.write(current)
        print('docs/ros_api.md: tables renewed')
        text = current
    advertised, parameters = names_in_code()
    findings = differences('topic or service', advertised | OF_LIBRARIES | OF_PATTERNS,
                           names_in_document(text, 'Subscribed topics', 'Published topics', 'Services'))
    findings += differences('parameter', parameters, names_in_document(text, 'Parameters that are read once'))
    if current != text:
        findings.append('docs/ros_api.md: a table is out of date; run scripts/check_ros_api.py --write')
    print('\n'.join(findings) if findings else
          f'docs/ros_api.md: {len(advertised)} topics and services and {len(parameters)} parameters as in the code')
    return 1 if findings else 0


if __name__ == '__main__':
    sys.exit(main())
