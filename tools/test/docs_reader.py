# SPDX-License-Identifier: Apache-2.0
"""Does what a page of the documentation says, as a reader would.

A page's blocks run in order, in one bash with an empty home folder. `bash` blocks run to their
end; `bash terminal` blocks run in a terminal of their own, with the same variables and folder,
until the comment `stop`; a block with `file=PATH` is written there. The lines of a `text` block
have to appear in what the block before it prints.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
import os
from pathlib import Path
import re
import signal
import subprocess
from typing import Any

__all__ = ['DOCS', 'LONG', 'PAGES', 'do_page']

FENCE = re.compile(
    r'^(?:<!-- (stop) -->|```(\w+)(?: (\S+))?\n(.*?)^```)$', flags=re.MULTILINE | re.DOTALL
)
DOCS = Path(__file__).resolve().parents[2] / 'docs'
PAGES = [*sorted(DOCS.glob('tutorial/*.md')), *sorted(DOCS.glob('how-to/*.md'))]
LONG = (
    *('apartment', 'assistants', 'bags', 'browser', 'classroom'),
    *('course_controllers', 'course_navigation', 'course_perception'),
    *('exercise_1', 'exercise_2', 'exercise_3', 'first_ten_minutes'),
    *('images_over_wifi', 'look_inside', 'move_arms', 'navigate', 'objects', 'robot_model'),
    *('ros_tutorials', 'simulation', 'sweep', 'take_things', 'tell_the_robot', 'train'),
    'use_your_own_yolo_model',
)
"""Pages that take twenty seconds or more beside other tests: `story_docs.py` does them.

The tutorial that everybody begins with is none of them.
"""


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, its mark and its text."""

    language: str
    mark: str
    text: str


def blocks(page: Path) -> Iterator[Block]:
    """Yield the blocks of a page."""
    for comment, language, mark, text in FENCE.findall(page.read_text()):
        yield Block(language, mark or comment, text)


class Reader:
    """Does what a page says."""

    def __init__(self, root: Path, home: Path, start: Callable[..., Any]) -> None:
        self._start = start
        self._state = home / '.state'
        self._home = home
        self._programs: list[Any] = []
        self._printed = ''
        keep = ('PATH', 'LANG', 'ROS_DOMAIN_ID')
        self._variables = {name: os.environ[name] for name in keep if name in os.environ}
        self._variables['PATH'] = '/usr/local/bin:/usr/bin:/bin'
        self._variables |= {'HOME': str(home), 'HUMANOID': str(root), 'PYTHON': 'python3'}
        self._state.write_text(f'cd "{home}"\n')

    def do(self, block: Block) -> None:
        """Do one block."""
        if block.mark.startswith('file='):
            path = Path(block.mark.removeprefix('file=').replace('~', str(self._home)))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text)
        elif block.language == 'text':
            self._expect(block.text)
        elif block.mark == 'terminal':
            command = f'source "{self._state}"; exec {block.text}'
            program = self._start('bash', '-c', command, env=self._variables)
            self._programs.append(program)
        elif block.mark == 'stop':
            for program in self._programs:
                program.end()
                assert program.members() == []
            self._programs = []
        elif block.language == 'bash':
            self._run(block.text)

    def _run(self, script: str) -> None:
        keep = f'{{ declare -px; echo "cd \\"$PWD\\""; }} > "{self._state}"'
        with subprocess.Popen(
            ['bash', '-c', f'set -e; source "{self._state}"; {script}\n{keep}'],
            env=self._variables,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding='utf-8',
            start_new_session=True,
        ) as process:
            try:
                self._printed, _ = process.communicate(timeout=170)
            except BaseException:
                # A command that is left would disturb the tests that get its DDS domain next.
                os.killpg(process.pid, signal.SIGKILL)
                raise
        assert process.returncode == 0, f'{script}\n{self._printed}'

    def _expect(self, text: str) -> None:
        for line in text.splitlines():
            if line in self._printed:
                continue
            assert self._programs, f'{line!r} is not in:\n{self._printed}'
            try:
                self._programs[-1].wait_for(line)
            except AssertionError as error:
                raise AssertionError(f'{error}\nnor in:\n{self._printed}') from error


def do_page(page: Path, root: Path, home: Path, start: Callable[..., Any]) -> None:
    """
    Do everything that a page tells its reader to do, and look for what it says is printed.

    Parameters
    ----------
    page
        The page.
    root
        The folder of the workspace.
    home
        An empty folder, the reader's home.
    start
        Starts a program in a terminal of its own: the fixture of that name.

    """
    reader = Reader(root, home, start)
    for block in blocks(page):
        reader.do(block)
