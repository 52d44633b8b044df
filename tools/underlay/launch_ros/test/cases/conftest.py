# SPDX-License-Identifier: Apache-2.0
"""
Cases that run the real `ros2 launch` and look at it from outside.

A case is a test of which the docstring says what holds, beginning with the section of the
specification of launch that says so. Its launch file is a text: the entities of a launch
description, a whole Python file, or the inside of <launch> or a YAML list. The program `rec`,
also an executable of the package `stub`, records how it was started.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import json
import os
from pathlib import Path
import re
import shutil
import signal
import subprocess
import sys
from textwrap import dedent, indent
import time
from typing import Any, Optional

import pytest
import yaml

TIMEOUT_S = 100.0
BANNER_LINES = 2

RECORDER = r"""#!/bin/sh
record=$REC_DIR/$$
printf '%s\0' "$@" >"$record.args"
cat "/proc/$$/environ" >"$record.env"
previous=
for word in "$@"; do
  [ "$previous" = --params-file ] && cp "$word" "$record.params.$(ls "$REC_DIR" | wc -l)"
  previous=$word
done
pwd >"$record.cwd"
eval "$REC_THEN"
"""

ATTEMPT = """
def attempt(context):
    import json
    for make in ATTEMPTS:
        try:
            made = make()
            getattr(made, 'perform', None) and made.perform(context)
            getattr(made, 'visit', None) and made.visit(context)
            print('!"accepted"')
        except Exception as error:
            print('!' + json.dumps(f'{type(error).__name__}: {error}'), flush=True)
---
OpaqueFunction(function=attempt),
"""

MODULES = (
    'launch',
    'launch.actions',
    'launch.conditions',
    'launch.descriptions',
    'launch.event_handlers',
    'launch.launch_description_sources',
    'launch.substitutions',
    'launch_ros.actions',
    'launch_ros.descriptions',
    'launch_ros.event_handlers',
    'launch_ros.substitutions',
    'launch_xml.launch_description_sources',
    'launch_yaml.launch_description_sources',
)


@dataclass(frozen=True)
class Run:
    """How `rec` was started."""

    args: list[str]
    env: dict[str, str]
    cwd: str
    params: list[dict[str, Any]]


@dataclass(frozen=True)
class Outcome:
    """What a launch did."""

    status: int
    stdout: str
    err: str
    here: Path
    prefix: Path

    @property
    def lines(self) -> list[str]:
        """Return the lines on the screen behind the first two."""
        return self.tidy(self.stdout).splitlines()[BANNER_LINES:]

    @property
    def text(self) -> str:
        """Return these lines as one text."""
        return '\n'.join(self.lines)

    @property
    def said(self) -> list[str]:
        """Return what LogInfo has said."""
        head = '[INFO] [launch.user]: '
        return [line.removeprefix(head) for line in self.lines if line.startswith(head)]

    @property
    def error(self) -> str:
        """Return the text of the exception that ended the launch."""
        head = 'Caught exception in launch (see debug for traceback): '
        return self.text.partition(head)[2]

    @property
    def log(self) -> list[str]:
        """Return the lines of launch.log without the time."""
        text = (self.here / 'log/latest/launch.log').read_text(encoding='utf-8')
        return [re.sub(r'^\d+\.\d{7} ', '', line) for line in self.tidy(text).splitlines()]

    def own_log(self, name: str) -> str:
        """Return the text of another log of the run."""
        return (self.here / 'log/latest' / name).read_text(encoding='utf-8')

    @property
    def runs(self) -> list[Run]:
        """Return how each `rec` was started."""
        return [_run_of(path) for path in sorted((self.here / 'rec').glob('*.cwd'), key=_age)]

    @property
    def run(self) -> Run:
        """Return how the only `rec` was started."""
        (run,) = self.runs
        return run

    @property
    def args(self) -> list[list[str]]:
        """Return the arguments of each `rec`, sorted, with names for temporary files."""
        return sorted([self.tidy(word) for word in run.args] for run in self.runs)

    def tidy(self, text: str) -> str:
        """Replace in a text what is different in each run."""
        text = re.sub(re.escape(str(self.here)) + r'/tmp/launch_params_\w+', 'PARAMS', text)
        text = text.replace(str(self.prefix), 'PREFIX').replace(str(self.here), 'HERE')
        return re.sub(r'\bpid (\[?)\d+', r'pid \1N', text)


def _age(path: Path) -> int:
    return path.stat().st_mtime_ns


def _run_of(path: Path) -> Run:
    def fields(suffix: str) -> list[str]:
        text = path.with_suffix(suffix).read_bytes().decode(errors='replace')
        return text.split('\0')[:-1]

    files = sorted(path.parent.glob(f'{path.stem}.params.*'), key=_age)
    return Run(
        args=fields('.args'),
        env=dict(field.split('=', 1) for field in fields('.env')),
        cwd=path.read_text().strip(),
        params=[yaml.safe_load(file.read_text(encoding='utf-8')) for file in files],
    )


class Running:
    """A launch in progress."""

    def __init__(self, process: subprocess.Popen[bytes], here: Path, prefix: Path) -> None:
        """Keep the process and where it writes."""
        self.process = process
        self._here, self._prefix = here, prefix

    @property
    def stdout(self) -> str:
        """Return what is on the screen so far."""
        return (self._here / 'stdout').read_text(encoding='utf-8', errors='replace')

    def wait_for(self, text: str, count: int = 1) -> Running:
        """Wait until a text is on the screen."""
        end = time.monotonic() + TIMEOUT_S
        while self.stdout.count(text) < count:
            assert self.process.poll() is None, f'ended without {text!r}:\n{self.stdout}'
            assert time.monotonic() < end, f'not on the screen: {text!r}:\n{self.stdout}'
            time.sleep(0.01)
        return self

    def send(self, number: signal.Signals) -> Running:
        """Send a signal to the launch only."""
        self.process.send_signal(number)
        return self

    def end(self) -> Outcome:
        """Wait until the launch ends."""
        status = self.process.wait(TIMEOUT_S)
        err = (self._here / 'stderr').read_text(encoding='utf-8', errors='replace')
        print(self.stdout, err)  # which a failing case shows
        return Outcome(status, self.stdout, err, self._here, self._prefix)


class Launcher:
    """Runs `ros2 launch` in a folder of its own."""

    def __init__(self, here: Path, prefix: Path) -> None:
        """Use a folder for all files, and a prefix with the package `stub`."""
        self.here, self.prefix = here, prefix
        self.started: list[Running] = []

    def __call__(self, text: str, *args: str, **options: Any) -> Outcome:
        """Launch a text and wait for the end."""
        return self.start(text, *args, **options).end()

    def start(
        self,
        text: str,
        *args: str,
        name: str = 'it.launch.py',
        files: Optional[dict[str, str]] = None,
        stdin: Any = subprocess.DEVNULL,
        **env: str,
    ) -> Running:
        """Write a launch file, and others, and launch it."""
        for each, content in {**(files or {}), name: text}.items():
            self.write(each, content)
        return self.run('launch', *args, name, stdin=stdin, **env)

    def show_args(self, text: str, **options: Any) -> Outcome:
        """Show the arguments of a text."""
        return self(text, '--show-args', **options)

    def errors(self, *attempts: str, before: str = '', **options: Any) -> list[str]:
        """
        Return the error of each of several expressions, which one launch makes and performs.

        How an error ends a launch is the matter of section 3.1.
        """
        lambdas = ''.join(f'    lambda: {attempt},\n' for attempt in attempts)
        text = f'{before}\nATTEMPTS = [\n{lambdas}]\n{ATTEMPT}'
        out = self(text, **options)
        assert (out.status, out.runs) == (0, [])
        lines = out.tidy(out.stdout).splitlines()
        found = [json.loads(line[1:]) for line in lines if line.startswith('!')]
        assert len(found) == len(attempts)
        return found

    def script(self, text: str, **env: str) -> Outcome:
        """Run a Python script with the same names imported."""
        path = self.write('script.py', _imports(dedent(text)) + dedent(text), wrap=False)
        return self._start([sys.executable, str(path)], subprocess.DEVNULL, env).end()

    def run(self, *words: str, stdin: Any = subprocess.DEVNULL, **env: str) -> Running:
        """Start `ros2` with some words; launch arguments are moved to the end."""
        arguments = [word for word in words if ':=' in word]
        others = [word for word in words if ':=' not in word]
        command = ['ros2', *others, *arguments]
        return self._start(command, stdin, env)

    def write(self, name: str, text: str, *, wrap: bool = True) -> Path:
        """Write a file; a launch file's text is completed."""
        path = self.here / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(_completed(name, text) if wrap else text, encoding='utf-8')
        return path

    def _start(self, command: list[str], stdin: Any, env: dict[str, str]) -> Running:
        for name in ('rec', 'tmp'):
            shutil.rmtree(self.here / name, ignore_errors=True)
            (self.here / name).mkdir()
        with open(self.here / 'stdout', 'wb') as out, open(self.here / 'stderr', 'wb') as err:
            process = subprocess.Popen(
                command,
                cwd=self.here,
                env={**self._environment(), **env},
                stdin=stdin,
                stdout=out,
                stderr=err,
                start_new_session=True,
            )
        self.started.append(Running(process, self.here, self.prefix))
        return self.started[-1]

    def _environment(self) -> dict[str, str]:
        kept = {
            name: value
            for name, value in os.environ.items()
            if not name.startswith(('OVERRIDE_LAUNCH_', 'PYTHONUN', 'ROS_HOME'))
        }
        return {
            **kept,
            'AMENT_PREFIX_PATH': f'{self.prefix}:{os.environ.get("AMENT_PREFIX_PATH", "")}',
            'PATH': f'{self.prefix}/lib/stub:{os.environ["PATH"]}',
            'REC_DIR': str(self.here / 'rec'),
            'ROS_LOG_DIR': str(self.here / 'log'),
            'TMPDIR': str(self.here / 'tmp'),
        }


def _completed(name: str, text: str) -> str:
    """Return the whole launch file of which a text gives what matters."""
    text = dedent(text).strip('\n') + '\n'
    if name.endswith('.xml') and not text.startswith('<launch'):
        return f'<launch>\n{indent(text, "  ")}</launch>\n'
    if name.endswith('.yaml') and 'launch' in name and not text.startswith('launch:'):
        return f'launch:\n{text}'
    if not name.endswith('.py'):
        return text
    if 'generate_launch_description' not in text:
        before, _, entities = text.rpartition('---\n')
        text = (
            f'{before}\n\ndef generate_launch_description():\n'
            f'    return LaunchDescription([\n{indent(entities, " " * 8)}    ])\n'
        )
    return _imports(text) + text


def _imports(text: str) -> str:
    """Return the import of each public name that a text contains."""
    words = set(re.findall(r'(?<![.\w])\w+\b', text))
    found: dict[str, str] = {}
    for module in MODULES:
        for name in words & set(_public_names(module)):
            found.setdefault(name, module)
    return ''.join(f'from {module} import {name}\n' for name, module in found.items())


def _public_names(module: str) -> list[str]:
    from importlib import import_module

    try:
        return [name for name in import_module(module).__all__ if name[0].isupper()]
    except ModuleNotFoundError:
        return []


@pytest.fixture(scope='session')
def stub_prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Install the package `stub` with the executable `rec`."""
    prefix = tmp_path_factory.mktemp('prefix')
    for path, text in {
        'share/ament_index/resource_index/packages/stub': '',
        'share/stub/data.txt': 'data',
        'lib/stub/rec': RECORDER,
        'lib/stub/deep/below': RECORDER,
        'lib/stub/plain': 'not executable',
        'share/ament_index/resource_index/packages/bare': '',
        'share/bare/data.txt': 'data',
    }.items():
        file = prefix / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    (prefix / 'lib/stub/rec').chmod(0o755)
    (prefix / 'lib/stub/deep/below').chmod(0o755)
    return prefix


@pytest.fixture
def launch(tmp_path: Path, stub_prefix: Path) -> Iterator[Launcher]:
    """Return what launches a text; whatever still runs is ended after the test."""
    launcher = Launcher(tmp_path, stub_prefix)
    yield launcher
    for each in launcher.started:
        if each.process.poll() is None:
            each.process.kill()
            each.process.wait()


@pytest.fixture
def alive() -> Callable[[int], bool]:
    """Return a function that tells whether a process runs."""

    def runs(pid: int) -> bool:
        try:
            state = Path(f'/proc/{pid}/stat').read_text().rpartition(') ')[2][0]
        except FileNotFoundError:
            return False
        return state != 'Z'

    return runs
