# SPDX-License-Identifier: Apache-2.0
"""
Measure what the first run costs: from nothing until the robot stands, and until all is built.

`tools/in_environment python3 tools/benchmarks/first_run.py --against FOLDER`. What is committed
here, and in turn in the other one, is cloned into a temporary folder. There `make bringup` runs
until the robot stands, and in another clone `make build`. Wheels come from the cache of pip: what
the network costs is not counted, if they were fetched before. CPU is that of all processes, the
robot's own until it stands included, and says more than the time of a machine that does other
things too.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
import os
from pathlib import Path
import signal
import subprocess
import tempfile
import time

from arguments import in_range, workspace_sources
from comparing import adopt_orphans, collect_orphans, without_environments
from domain_coordinator import domain_id

HERE = Path(__file__).resolve().parents[2]
STARTED = 'Joint Controller started'
LISTEN = ('topic', 'echo', '--once', '--qos-durability', 'transient_local')
LISTENED = ('/walking_state', 'std_msgs/msg/String')
TIMEOUT_S = 3600.0
GRACE_S = 60.0
WHOLE = {'bringup': 'make bringup, until the robot stands', 'build': 'make build, everything'}


@dataclass(frozen=True)
class Cost:
    """The cost of a first run: wall time and CPU time."""

    wall_s: float
    cpu_s: float


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--runs', type=in_range(int, 1), default=1, help='runs of each row')
    parser.add_argument(
        '--against', type=workspace_sources, metavar='FOLDER', help='another workspace'
    )
    parser.add_argument('--only', choices=sorted(WHOLE), help='one of the two rows')
    options = parser.parse_args()
    adopt_orphans()
    folders = [HERE] if options.against is None else [HERE, options.against]
    print(f'Least of {options.runs} runs in turn: {" against ".join(map(str, folders))}')
    print(f'{"wall s":>8} {"CPU s":>8}   ' * len(folders) + 'ratios')
    for command in [options.only] if options.only else WHOLE:
        runs = [[first_run(folder, command) for folder in folders] for _ in range(options.runs)]
        print(row([least(list(each)) for each in zip(*runs)]) + f'  {WHOLE[command]}', flush=True)


def row(costs: list[Cost]) -> str:
    """
    Format a row of the table, with the ratios of the first to the second workspace.

    Parameters
    ----------
    costs
        The costs in each workspace: one or two.

    """
    text = ''.join(f'{cost.wall_s:8.1f} {cost.cpu_s:8.1f}   ' for cost in costs)
    if len(costs) == 1:
        return text
    here, there = costs
    return f'{text}{here.wall_s / there.wall_s:.2f} {here.cpu_s / there.cpu_s:.2f}'


def least(costs: list[Cost]) -> Cost:
    """
    Return the minimum wall time and the minimum CPU time of several runs.

    Parameters
    ----------
    costs
        The cost of each run.

    """
    return Cost(min(cost.wall_s for cost in costs), min(cost.cpu_s for cost in costs))


def first_run(folder: Path, command: str) -> Cost:
    """
    Clone a workspace and measure a command of `make` in it, from scratch.

    Parameters
    ----------
    folder
        The workspace to clone.
    command
        `bringup`, which ends when the robot stands, or `build`.

    Raises
    ------
    RuntimeError
        The build has failed, or no robot has started.

    """
    with tempfile.TemporaryDirectory(prefix='first_run_') as temporary:
        clone = Path(temporary, 'workspace')
        subprocess.run(['git', 'clone', '--quiet', '--no-hardlinks', folder, clone], check=True)
        before_s = os.times()
        begin_s = time.monotonic()
        with made(clone, command) as process:
            if command == 'bringup':
                wait_until_it_stands(clone, process)
            else:
                process.wait(TIMEOUT_S)
            wall_s = time.monotonic() - begin_s
        after_s = os.times()
        cpu_s = after_s.children_user + after_s.children_system
        return Cost(wall_s, cpu_s - before_s.children_user - before_s.children_system)


@contextmanager
def made(clone: Path, command: str) -> Iterator[subprocess.Popen[bytes]]:
    """
    Run `make` during a `with` block, then end it.

    Parameters
    ----------
    clone
        The folder where it runs.
    command
        `bringup`, without the page, or `build`.

    Yields
    ------
    Popen
        The process of make, the leader of its own session.

    Raises
    ------
    RuntimeError
        `make build` has failed; the message quotes its output.

    """
    arguments = ['ARGS=gui:=false'] if command == 'bringup' else []
    with output_of(clone).open('wb') as stream:
        process = subprocess.Popen(
            ['make', '-C', clone, command, *arguments],
            env=variables(),
            stdin=subprocess.DEVNULL,
            stdout=stream,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        process.wait(GRACE_S)
        collect_orphans()
    if command == 'build' and process.returncode != 0:
        raise RuntimeError(f'`make {command}` has failed:\n{output_of(clone).read_text()}')


def variables() -> dict[str, str]:
    """Return the variables of a shell in which nothing is sourced."""
    kept = ('PATH', 'HOME', 'LANG', 'ROS_DOMAIN_ID', 'XDG_CACHE_HOME', 'TERM')
    shell = {name: os.environ[name] for name in kept if name in os.environ}
    return {**shell, 'PATH': without_environments(shell['PATH'])}


def wait_until_it_stands(clone: Path, process: subprocess.Popen[bytes]) -> None:
    """
    Wait until the bring-up runs and the robot stands, which publishes its walking state.

    Parameters
    ----------
    clone
        The folder of the workspace.
    process
        The process of `make bringup`.

    Raises
    ------
    RuntimeError
        The process has ended, or takes longer than `TIMEOUT_S`; the message quotes its output.

    """
    end_s = time.monotonic() + TIMEOUT_S
    while STARTED not in output_of(clone).read_text(errors='replace'):
        if process.poll() is not None or time.monotonic() > end_s:
            raise RuntimeError(f'No robot has started:\n{output_of(clone).read_text()}')
        time.sleep(0.1)
    listener = [clone / 'tools' / 'ros2', *LISTEN, *LISTENED]
    subprocess.run(listener, env=variables(), stdout=subprocess.DEVNULL, check=True, timeout=600)


def output_of(clone: Path) -> Path:
    """
    Return the file with the output of `make`.

    Parameters
    ----------
    clone
        The folder where it runs; the file is beside it.

    """
    return clone.parent / 'output.txt'


if __name__ == '__main__':
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        main()
