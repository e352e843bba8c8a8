#!/usr/bin/env python3
"""Runs the command blocks of README.md as they stand there, from the top of the checkout.

usage: check_readme.py [--markers]

Above each block stands what is to be done with it:
  <!-- check: run -->                 its commands end by themselves, and succeed
  <!-- check: until TOPIC -->         its last command goes on; a message has to come on TOPIC
  <!-- check: beside COMMAND -->      as 'run', while COMMAND goes on
  <!-- check: not run, REASON -->     it cannot run here, or something else runs it
With --markers the marks alone are looked at. The package has to be built. A virtual display, a ROS master's address and
the folders of ROS are the check's own.
"""
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parent.parent
MARK = re.compile(r'<!-- check: (run|until (?P<topic>/\S+)|beside (?P<beside>.+)|not run, (?P<reason>.+)) -->')
# Of a block that goes on: RViz on a slow machine takes most of it. And of one that ends.
PATIENCE_S = 180
LONGEST_RUN_S = 600


class Block:
    def __init__(self, line, mark, commands):
        self.line = line
        self.mark = mark
        self.commands = commands


def blocks_of(path):
    """@return blocks of commands: fenced, without a language or with that of a shell"""
    blocks = []
    lines = path.read_text().splitlines()
    number = 0
    while number < len(lines):
        if not lines[number].startswith('```'):
            number += 1
            continue
        language = lines[number][3:].strip()
        end = next(i for i in range(number + 1, len(lines)) if lines[i].startswith('```'))
        if language in ('', 'bash', 'sh'):
            blocks.append(Block(number + 1, MARK.match(lines[number - 1]), '\n'.join(lines[number + 1:end])))
        number = end + 1
    return blocks


def free_port():
    with socket.socket() as own:
        own.bind(('', 0))
        return own.getsockname()[1]


def end(process):
    """Ends a process and what it has begun."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGINT)
    try:
        process.wait(20)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


class Machine:
    """What the blocks run on."""

    def __init__(self, scratch):
        self.scratch = pathlib.Path(scratch)
        self.environment = {name: value for name, value in os.environ.items()
                            if name not in ('PYTHONPATH', 'PYTHONHOME', 'DISPLAY')}
        # ROS's own Python must come first.
        self.environment.update(
            PATH='/usr/bin:/bin:/usr/sbin:/sbin', ROS_HOME=f'{scratch}/ros', ROS_LOG_DIR=f'{scratch}/log',
            XDG_RUNTIME_DIR=scratch, LIBGL_ALWAYS_SOFTWARE='1', ROSCONSOLE_STDOUT_LINE_BUFFERED='1',
            ROS_MASTER_URI=f'http://localhost:{free_port()}')
        self.display = None

    def __enter__(self):
        reader, writer = os.pipe()
        self.display = subprocess.Popen(
            ['Xvfb', '-displayfd', str(writer), '-screen', '0', '1600x900x24', '+extension', 'GLX'], pass_fds=[writer],
            env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(writer)
        with os.fdopen(reader) as number:
            self.environment['DISPLAY'] = ':' + number.readline().strip()
        return self

    def __exit__(self, *_):
        end(self.display)

    def start(self, commands, log):
        return subprocess.Popen(['bash', '-e', '-c', commands], cwd=TOP, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

    def run(self, block, log):
        """@return what went wrong, or None"""
        process = self.start(block.commands, log)
        try:
            return None if process.wait(LONGEST_RUN_S) == 0 else f'exit code {process.returncode}'
        except subprocess.TimeoutExpired:
            return f'not done after {LONGEST_RUN_S} s'
        finally:
            end(process)

    def run_beside(self, block, command, log):
        other = self.start(f'. devel/setup.bash; exec {command}', log)
        # Its node answers when it has come up.
        wait = self.start('set +e; . devel/setup.bash; until rosservice list 2>/dev/null | grep -q /reset; do sleep 1; done', log)
        try:
            wait.wait(PATIENCE_S)
            return self.run(block, log)
        except subprocess.TimeoutExpired:
            return f'{command} did not come up within {PATIENCE_S} s'
        finally:
            end(wait)
            end(other)

    def run_until(self, block, topic, log):
        process = self.start(block.commands, log)
        # Names of messages and packages come from the same setup file as the block's own.
        listener = self.start(f'set +e; . devel/setup.bash; until rostopic echo -n 1 --noarr {topic}; do sleep 1; done', log)
        deadline = time.monotonic() + PATIENCE_S
        try:
            while time.monotonic() < deadline:
                if listener.poll() is not None:
                    return None
                if process.poll() is not None:
                    return f'ended with exit code {process.returncode} before a message on {topic}'
                time.sleep(0.2)
            return f'no message on {topic} within {PATIENCE_S} s'
        finally:
            end(listener)
            end(process)


def check(machine, block):
    """@return whether the block does what its mark says"""
    first_line = block.commands.splitlines()[0]
    if block.mark['reason']:
        print(f'README.md:{block.line}: not run, {block.mark["reason"]}: {first_line} ...')
        return True
    print(f'README.md:{block.line}: {first_line} ...', flush=True)
    log_path = machine.scratch / f'block_{block.line}.log'
    with open(log_path, 'w') as log:
        topic = block.mark['topic']
        if topic:
            problem = machine.run_until(block, topic, log)
        elif block.mark['beside']:
            problem = machine.run_beside(block, block.mark['beside'], log)
        else:
            problem = machine.run(block, log)
    if problem:
        print(''.join(log_path.open().readlines()[-30:]))
        print(f'README.md:{block.line}: {problem}')
    return problem is None


def main():
    blocks = blocks_of(TOP / 'README.md')
    unmarked = [block for block in blocks if not block.mark]
    for block in unmarked:
        print(f'README.md:{block.line}: no "<!-- check: ... -->" in the line above the block; see {sys.argv[0]}')
    if unmarked or '--markers' in sys.argv[1:]:
        sys.exit(1 if unmarked else 0)
    with tempfile.TemporaryDirectory() as scratch, Machine(scratch) as machine:
        failed = [block for block in blocks if not check(machine, block)]
    print(f'{len(blocks) - len(failed)} blocks of README.md as they should be, {len(failed)} not')
    sys.exit(1 if failed else 0)


if __name__ == '__main__':
    main()
