# SPDX-License-Identifier: Apache-2.0
"""A program cannot tell whether it was executed or forked."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress
from dataclasses import dataclass
import json
import os
from pathlib import Path
import signal
import sys
from typing import Any

from launch._supervision.family import Family
from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.prefork.prefork import kind_of
from launch._supervision.prefork.template_handle import TemplateHandle
from launch._supervision.program import Child, execute, Program
import pytest

# No link: a path with spaces cannot stand in the first line of a script.
INTERPRETER = Path(sys.executable).parent.resolve() / 'python3'
PRELOADER = """
import gc, json, random
EARLY_VARIABLES = frozenset()
def preload(scripts): pass
def before_fork(): pass
def after_fork(): pass
"""

PROBE = """
'''The documentation of the script.'''
import atexit, ctypes, gc, json, locale, logging, os, resource, signal, sys, threading, warnings
names = sorted(vars())
value: int = 1

def stream(name):
    found = getattr(sys, name)
    binary = found.buffer
    return [repr(found), found.encoding, found.errors, found.line_buffering, found.mode,
            found.write_through, found.isatty(), found.fileno(), type(binary).__name__,
            repr(getattr(binary, 'raw', binary)), found is getattr(sys, f'__{name}__'),
            str(found.newlines), binary.mode]

def status(*wanted):
    lines = open('/proc/self/status').read().splitlines()
    return {k: v.strip() for k, v in (line.split(':', 1) for line in lines) if k in wanted}

def read(name):
    return open(f'/proc/self/{name}').read()

def prctl(operation):
    number = ctypes.c_int(-1)
    ctypes.CDLL(None).prctl(operation, ctypes.byref(number), 0, 0, 0)
    return number.value

main = sys.modules['__main__']
facts = {
    'argv': sys.argv, 'orig_argv': sys.orig_argv, 'path': sys.path, 'flags': repr(sys.flags),
    'executable': [sys.executable, sys.prefix, sys.exec_prefix, sys._base_executable],
    'warnings': [sys.warnoptions, repr(warnings.filters)], 'xoptions': sys._xoptions,
    'main': [repr(main), main.__name__, main.__doc__, main.__file__, repr(main.__spec__),
             repr(main.__package__), repr(main.__cached__), type(main.__loader__).__name__,
             main.__loader__.name, main.__loader__.path, repr(main.__builtins__),
             repr(main.__annotations__), vars(main) is globals()],
    'names': names,
    'environment': list(os.environ.items()),
    'c environment': read('environ'), 'command line': read('cmdline'), 'name': read('comm'),
    'program': os.readlink('/proc/self/exe'), 'folder': os.getcwd(),
    'stdin': stream('stdin'), 'stdout': stream('stdout'), 'stderr': stream('stderr'),
    'handlers': {n: repr(signal.getsignal(n)).split(' at ')[0] for n in signal.valid_signals()},
    'mask': repr(signal.pthread_sigmask(signal.SIG_BLOCK, [])),
    'status': status('SigBlk', 'SigIgn', 'SigCgt', 'Threads', 'Umask', 'NoNewPrivs', 'Seccomp',
                     'CoreDumping', 'SigPnd', 'ShdPnd', 'Cpus_allowed'),
    'limits': read('limits'), 'oom': [read('oom_score_adj'), read('coredump_filter')],
    'descriptors': [[n, os.path.exists('/proc/self/fd/' + n)]
                    for n in os.listdir('/proc/self/fd')],
    'inheritable': [os.get_inheritable(n) for n in range(3)],
    'leads': [os.getsid(0) == os.getpid(), os.getpgrp() == os.getpid()],
    'parent': os.getppid(), 'nice': os.nice(0),
    'threads': [repr(threading.enumerate()).split(' ')[0], threading.current_thread().name,
                threading.main_thread().native_id == os.getpid()],
    'collector': [gc.isenabled(), gc.get_threshold(), gc.get_debug()],
    'log': [repr(logging.getLogger().handlers), logging.getLogger().level,
            logging.getLoggerClass().__name__],
    'locale': [locale.setlocale(locale.LC_ALL), sys.getfilesystemencoding()],
    'hooks': [sys.excepthook is sys.__excepthook__, sys.displayhook is sys.__displayhook__,
              sys.gettrace() is None, sys.getprofile() is None, sys.getrecursionlimit(),
              sys.getswitchinterval(), repr(threading.excepthook)],
    'finders': [[repr(f).split(' at ')[0] for f in sys.meta_path], len(sys.path_hooks)],
    'launch': [name for name in sys.modules if name.startswith(('launch', 'plain_preload'))],
    'subreaper, death signal, dumpable': [prctl(37), prctl(2), ctypes.CDLL(None).prctl(3)],
    'controlling terminal': read('stat').rpartition(')')[2].split()[4],
    'frames': sys._getframe().f_code.co_filename,
}
atexit.register(print, 'atexit')
print(json.dumps(facts))
"""


@dataclass
class Outcome:
    """How a program ended, and what it wrote."""

    status: int
    out: str
    err: str


Spawn = Callable[[Program, int, int], Awaitable[Child]]


async def _outcome(
    spawn: Spawn, program: Program, tty: bool, disturb: Callable[[Child], None]
) -> Outcome:
    readers, writers = zip(*[os.openpty() if tty else os.pipe() for _ in range(2)])
    child = await spawn(program, *writers)
    for writer in writers:
        os.close(writer)
    disturb(child)
    loop = asyncio.get_running_loop()
    texts = [await loop.run_in_executor(None, _read_all, reader) for reader in readers]
    status = await loop.run_in_executor(None, child.wait)
    assert child.stdin is not None
    child.stdin.close()
    return Outcome(status, *texts)


def _read_all(descriptor: int) -> str:
    data = []
    try:
        while piece := os.read(descriptor, 65536):
            data.append(piece)
    except OSError:
        pass  # the end of a terminal
    os.close(descriptor)
    return b''.join(data).decode().replace('\r\n', '\n')


Both = Callable[..., tuple[Outcome, Outcome]]


@pytest.fixture
def both(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Both:
    """Return a function that runs a script both ways."""
    (tmp_path / 'plain_preload.py').write_text(PRELOADER)
    monkeypatch.syspath_prepend(str(tmp_path))

    def run(
        source: str,
        *arguments: str,
        tty: bool = False,
        disturb: Callable[[Child], None] = lambda child: None,
        **variables: str,
    ) -> tuple[Outcome, Outcome]:
        folder = tmp_path / 'a folder'
        folder.mkdir(exist_ok=True)
        script = tmp_path / 'a_script_with_a_long_name'
        script.write_text(f'#!{INTERPRETER}\n{source}')
        script.chmod(0o755)
        environment = {**os.environ, 'PYTHONPATH': str(tmp_path), 'WORD': 'ö=1', **variables}
        program = Program(
            command=[str(script), *arguments],
            cwd=str(folder),
            env=environment,
            shell=False,
            preloader='plain_preload',
        )
        return asyncio.run(_both(program, tty, disturb))

    return run


async def _both(
    program: Program, tty: bool, disturb: Callable[[Child], None]
) -> tuple[Outcome, Outcome]:
    assert program.env is not None
    kind = kind_of(program, program.env)
    assert kind is not None, 'the script cannot be forked'
    other = {**program.env, 'REMOVED': 'yes', 'WORD': 'changed'}
    guard = OrphanGuard(Family.of_new_run())
    template = TemplateHandle(kind, other, [], guard)
    try:
        forked = await _outcome(template.fork, program, tty, disturb)
    finally:
        template.close()
        guard.close()
    return await _outcome(execute, program, tty, disturb), forked


@pytest.mark.parametrize('tty', [False, True], ids=['pipe', 'terminal'])
@pytest.mark.parametrize('unbuffered', ['', '1'])
def test_facts(both: Both, tty: bool, unbuffered: bool) -> None:
    """All that a program finds is the same."""
    executed, forked = both(
        PROBE, '--ros-args', '', 'two words', 'ö', tty=tty, PYTHONUNBUFFERED=unbuffered
    )
    assert (forked.status, forked.err) == (executed.status, executed.err) == (0, '')
    expected, found = (
        json.loads(executed.out.splitlines()[0]),
        json.loads(forked.out.splitlines()[0]),
    )
    for name, value in expected.items():
        assert found[name] == value, name
    assert found['parent'] == os.getpid()
    assert executed.out.splitlines()[1:] == forked.out.splitlines()[1:] == ['atexit']


ENDS: dict[str, Any] = {
    'nothing': ('pass', 0),
    'exit 3': ('import sys; sys.exit(3)', 3),
    'exit with a text': ("import sys; sys.exit('text')", 1),
    'exit with None': ('raise SystemExit', 0),
    'exit 300': ('import sys; sys.exit(300)', 44),
    'exception': ('def f():\n    raise ValueError(1)\nf()', 1),
    'chain': ('try:\n    1/0\nexcept ZeroDivisionError as e:\n    raise OSError from e', 1),
    'syntax': ('a = (', 1),
    'own hook': ('import sys\nsys.excepthook = lambda *a: print(a[0], a[2].tb_next)\n1/0', 1),
    'failing hook': ('import sys\nsys.excepthook = lambda *a: 1/0\nint("x")', 1),
    'interrupt': ('raise KeyboardInterrupt', -signal.SIGINT),
    'exit from atexit': ('import atexit, os; atexit.register(os._exit, 5)', 5),
    'abort': ('import os; os.abort()', -signal.SIGABRT),
    'kill': ('import os; os.kill(os.getpid(), 9)', -signal.SIGKILL),
    'os._exit': ('import os; os._exit(9)', 9),
    'unflushed': ("print('unflushed', end='')", 0),
    'threads': ('import threading; threading.Thread(target=print, args=["x"]).start()', 0),
    'thread dies': ('import threading; threading.Thread(target=lambda: 1/0).start()', 0),
    'fork': ('import os\nif os.fork() == 0: os._exit(7)\nprint(os.wait()[1] >> 8)', 0),
    'subprocess': ('import subprocess; print(subprocess.run(["sh", "-c", "exit 3"]))', 0),
    'multiprocessing': (
        'import multiprocessing as m\n'
        "if __name__ == '__main__':\n"
        "    p = m.get_context('spawn').Process(target=print, args=['x']); p.start(); p.join()",
        0,
    ),
    'stdin': ('import sys; print(sys.stdin.readline())', 0),
    'warning': ('import warnings; warnings.warn("careful")', 0),
    'asyncio': ('import asyncio; asyncio.run(asyncio.sleep(0)); print("slept")', 0),
}


@pytest.mark.parametrize(('source', 'status'), ENDS.values(), ids=ENDS)
def test_ends(both: Both, source: str, status: int) -> None:
    """Exit status and output are the same, however a program ends."""

    def say_line(child: Child) -> None:
        assert child.stdin is not None
        with suppress(BrokenPipeError):  # it may have ended by now
            child.stdin.write(b'line\n')

    executed, forked = both(source, disturb=say_line)
    masked = [text.replace('template.py', '') for text in (executed.err, forked.err)]
    assert executed.status == forked.status == status
    assert executed.out == forked.out
    if source.startswith('import threading'):
        masked = [text.split('Traceback')[-1] for text in masked]
    assert masked[0].split('Original')[-1] == masked[1].split('Original')[-1]


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1])
def test_signals(
    both: Both, tmp_path: Path, wait_until: Callable[..., None], number: signal.Signals
) -> None:
    """A signal ends a program as it does when the program was executed."""
    at_work = tmp_path / 'at_work'

    def send(child: Child) -> None:
        wait_until(at_work.exists)  # before, Python itself may be interrupted
        at_work.unlink()
        os.kill(child.pid, number)

    source = f"""
import signal, time
signal.pthread_sigmask(signal.SIG_BLOCK, [])
with open({str(at_work)!r}, 'w'):
    for _ in range(300):
        time.sleep(0.1)
"""
    executed, forked = both(source, disturb=send)
    assert executed.status == forked.status == -number


def test_randomness(both: Both) -> None:
    """Copies do not repeat each other's random numbers."""
    numbers = set()
    for _ in range(2):
        numbers |= {o.out for o in both('import random; print(random.random())')}
    assert len(numbers) == 4
