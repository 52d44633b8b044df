# SPDX-License-Identifier: Apache-2.0
"""
Do a sweep on a Ray cluster of two nodes here, kill parts of it on the way, and check the table.

Killed with SIGKILL, one after the other: a worker in the middle of a task; the second node with
its workers, which then starts anew; the head, with which the sweep ends. The head starts anew, and
the same command does what is left. At the end, the Parquet table and the record must have each run
once, and its results must be those of a sweep in local processes, bit for bit. Needs
`make cluster`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
import json
import os
from pathlib import Path
import shutil
import signal
import socket
import subprocess
import sys
from tempfile import TemporaryDirectory
import time

from arguments import in_range
from humanoid_simulation.sweep.experiment import load_experiment
from pyarrow import parquet

EXPERIMENT = """
method: random
runs: {runs}
conditions:
  seconds: {seconds}
  forward_m_s: {{from: 0.0, to: 0.3}}
  push_at_s: 1.5
  push_ns: {{from: 0.0, to: 60.0}}
"""
HOST = '127.0.0.1'
START_S, END_S = 60.0, 120.0
NOT_COMPARED = ('cpu_s', 'finished_at')
SHARES = {'worker': 0.2, 'node': 0.4, 'head': 0.6}
"""How many of the runs are finished when something is killed."""


@dataclass
class Node:
    """A node of the cluster: `ray start --block`, and all processes below it."""

    process: subprocess.Popen[bytes]

    @property
    def processes(self) -> list[int]:
        """Return the ids of all its processes."""
        return descendants(self.process.pid)

    def kill(self) -> None:
        """End all processes at once, as when the plug is pulled."""
        for process in (self.process.pid, *self.processes):
            end(process)
        self.process.wait()

    def workers(self) -> list[int]:
        """Return the ids of the processes that do a task just now."""
        return [each for each in self.processes if 'ray::do_runs' in command_of(each)]


def descendants(parent: int) -> list[int]:
    """
    Return the ids of all processes below one.

    Parameters
    ----------
    parent
        The id of that process.

    """
    children: dict[int, list[int]] = {}
    for path in Path('/proc').glob('[0-9]*/stat'):
        try:
            fields = path.read_text().rpartition(')')[2].split()
        except OSError:
            continue  # it has ended
        children.setdefault(int(fields[1]), []).append(int(path.parent.name))
    found: list[int] = []
    waiting = [parent]
    while waiting:
        below = children.get(waiting.pop(), [])
        found += below
        waiting += below
    return found


def command_of(process: int) -> str:
    """
    Return the command line of a process; '' if it has ended.

    Parameters
    ----------
    process
        The process id.

    """
    try:
        return Path(f'/proc/{process}/cmdline').read_text()
    except OSError:
        return ''


def end(process: int) -> None:
    """
    Send SIGKILL to a process that this program has started.

    Parameters
    ----------
    process
        The process id.

    """
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass


def free_port() -> int:
    """Return a port that nothing uses."""
    with socket.socket() as found:
        found.bind((HOST, 0))
        return int(found.getsockname()[1])


class Cluster:
    """
    A head and a second node, each with one CPU for runs, on this machine.

    Parameters
    ----------
    folder
        Where Ray puts its files; short, since it has sockets there.

    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._port = free_port()
        self.address = f'{HOST}:{self._port}'
        self.client = f'ray://{HOST}:{free_port()}'

    def start_head(self) -> Node:
        """Start the node that the others and the sweep connect with."""
        return self._start(
            '--head',
            f'--port={self._port}',
            f'--ray-client-server-port={self.client.rpartition(":")[2]}',
            f'--temp-dir={self._folder}',
            '--include-dashboard=false',
        )

    def start_second(self) -> Node:
        """Start the node that only does runs."""
        return self._start(f'--address={self.address}')

    def _start(self, *arguments: str) -> Node:
        """Start a node, and wait until it has."""
        command = ['ray', 'start', '--block', '--num-cpus=1', '--num-gpus=0', *arguments]
        command += [f'--node-ip-address={HOST}', '--disable-usage-stats']
        log = self._folder / f'start_{time.monotonic_ns()}.log'
        with log.open('wb') as stream:
            process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=stream, stderr=stream,
                start_new_session=True,
            )  # fmt: skip
        try:
            wait_for(
                lambda: 'Ray runtime started' in log.read_text() or process.poll() is not None,
                START_S,
                f'{command}',
            )
        except BaseException:
            Node(process).kill()
            raise
        if process.poll() is not None:
            raise SystemExit(f'{" ".join(command)} has ended: {log.read_text()}')
        return Node(process)


def wait_for(is_true: Callable[[], bool], most_s: float, what: str) -> float:
    """
    Wait until something is true, and return how long that took in s.

    Parameters
    ----------
    is_true
        Whether it is.
    most_s
        How long to wait at most.
    what
        What is waited for, for the error.

    Raises
    ------
    SystemExit
        It did not become true.

    """
    begin_s = time.monotonic()
    while not is_true():
        if time.monotonic() - begin_s > most_s:
            raise SystemExit(f'Timed out after {most_s:.0f} s: {what}')
        time.sleep(0.05)
    return time.monotonic() - begin_s


@dataclass
class Folder:
    """The folder of a sweep."""

    path: Path

    def keys(self) -> list[str]:
        """Return the keys of the finished runs in the record, also those that are there twice."""
        path = self.path / 'runs.jsonl'
        if not path.exists():
            return []
        entries = [json.loads(line) for line in path.read_text().splitlines(keepends=True)
                   if line.endswith('\n')]  # fmt: skip
        return [entry['key'] for entry in entries if 'result' in entry]

    def crashes(self) -> int:
        """Return the number of crashes in the record."""
        return (self.path / 'runs.jsonl').read_text().count('"reason"')

    def rows(self) -> dict[tuple[str, str], dict[str, object]]:
        """Return the rows of the table by version and key, without times; each is there once."""
        rows = parquet.read_table(self.path / 'runs.parquet').to_pylist()
        found = {(row['version'], row['key']): row for row in rows}
        if len(found) != len(rows):
            raise SystemExit(f'{len(rows) - len(found)} rows of the table are there twice.')
        return {
            name: {key: value for key, value in row.items() if key not in NOT_COMPARED}
            for name, row in found.items()
        }


@contextmanager
def sweep(experiment: Path, folder: Folder, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """
    Start the command, and end it at the end of the block if it has not ended.

    Parameters
    ----------
    experiment, folder
        The experiment, and where its results go.
    *arguments
        Further arguments of the command.

    Yields
    ------
    Popen
        The process.

    """
    command = ['ros2', 'run', 'humanoid_simulation', 'sweep', str(experiment)]
    command += ['--output', str(folder.path), *arguments]
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, start_new_session=True,
    ) as process:  # fmt: skip
        try:
            yield process
        finally:
            for each in (process.pid, *descendants(process.pid)) if process.poll() is None else ():
                end(each)


def finished(experiment: Path, folder: Folder, *arguments: str) -> float:
    """
    Do the command to its end, and return how long it took in s.

    Parameters
    ----------
    experiment, folder
        The experiment, and where its results go.
    *arguments
        Further arguments of the command.

    Raises
    ------
    SystemExit
        It has ended with another status than 0.

    """
    begin_s = time.monotonic()
    with sweep(experiment, folder, *arguments) as process:
        output, _ = process.communicate(timeout=10 * END_S)
    if process.returncode:
        raise SystemExit(f'The sweep has ended with status {process.returncode}:\n{output}')
    return time.monotonic() - begin_s


def interrupted(
    cluster: Cluster, nodes: list[Node], experiment: Path, folder: Folder, runs: int
) -> None:
    """
    Do the sweep while parts of the cluster are killed, until it ends with its head.

    Parameters
    ----------
    cluster, nodes
        The cluster, and its head and second node; a new second node replaces the killed one.
    experiment, folder
        The experiment, and where its results go.
    runs
        The number of its runs.

    """
    with sweep(experiment, folder, '--ray', cluster.address) as process:

        def after(part: str) -> None:
            wait_for(
                lambda: len(folder.keys()) >= SHARES[part] * runs or process.poll() is not None,
                END_S,
                f'the time to kill the {part}',
            )
            print(f'  {len(folder.keys()):2} of {runs} are finished: kill -9 the {part}')

        def second_works() -> None:
            wait_for(lambda: bool(nodes[1].workers()), END_S, 'a worker with a task')

        after('worker')
        second_works()
        end(nodes[1].workers()[0])
        after('node')
        second_works()
        nodes[1].kill()
        nodes[1] = cluster.start_second()
        after('head')
        nodes[0].kill()
        wait_s = wait_for(lambda: process.poll() is not None, END_S, 'the end of the sweep')
        assert process.stdout is not None
        output = process.stdout.read()
    print(f'  the sweep has ended {wait_s:.1f} s later with status {process.returncode}; it said:')
    for line in output.splitlines():
        if ' | ' not in line:
            print(f'    {line}')


def check(cluster_sweep: Folder, local_sweep: Folder, planned: Sequence[str]) -> bool:
    """
    Compare record, table and plan, and print what is found.

    Parameters
    ----------
    cluster_sweep, local_sweep
        The folders of the sweep on the cluster, and of that in local processes.
    planned
        The keys of the planned runs.

    Returns
    -------
    bool
        Whether the cluster did each run once, with the same result.

    """
    keys, rows = cluster_sweep.keys(), cluster_sweep.rows()
    lost = {*planned} - {*keys}
    same = rows == local_sweep.rows()
    print(
        f'{len(planned)} runs are planned, {len(rows)} are in the table; {len(lost)} are lost, '
        f'{len(keys) - len({*keys})} are recorded twice; '
        f'{cluster_sweep.crashes()} crashes are recorded'
    )
    print(f'the results are {"" if same else "NOT "}those of local processes, bit for bit')
    return not lost and len(rows) == len(keys) == len(planned) and same


def main() -> int:
    """Do the trial; the exit code says whether no run was lost, and none was done twice."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--runs', type=in_range(int, 10), default=60)
    parser.add_argument('--seconds', type=in_range(float, 2.0), default=5.0, help='of each run')
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # so that no node is left
    if shutil.which('ray') is None:
        print('There is no Ray here: run `make cluster` first.', file=sys.stderr)
        return 2
    with TemporaryDirectory(prefix='ray_', dir='/tmp') as place:
        folder = Path(place)
        experiment = folder / 'short.yaml'
        experiment.write_text(EXPERIMENT.format(**vars(arguments)))
        planned = [run.key for run in load_experiment(str(experiment), []).runs]
        local, whole, killed = (Folder(folder / name) for name in ('local', 'whole', 'killed'))
        time_s = finished(experiment, local, '--processes', '2')
        print(f'{time_s:6.1f} s  {arguments.runs} runs in two local processes', flush=True)
        cluster = Cluster(folder)
        nodes: list[Node] = []
        try:
            nodes += [cluster.start_head()]
            nodes += [cluster.start_second()]
            for name, address in (('its port', cluster.address), ('ray://', cluster.client)):
                output = Folder(Path(f'{whole.path}_{len(name)}'))
                time_s = finished(experiment, output, '--ray', address)
                same = 'same' if output.rows() == local.rows() else 'OTHER'
                print(f'{time_s:6.1f} s  on two nodes of Ray, by {name}; {same} results',
                      flush=True)  # fmt: skip
            print('Again, with kills:', flush=True)
            interrupted(cluster, nodes, experiment, killed, arguments.runs)
            nodes[1].kill()
            nodes[:] = [cluster.start_head()]
            nodes += [cluster.start_second()]
            before = len(killed.keys())
            time_s = finished(experiment, killed, '--ray', cluster.address)
            print(f'{time_s:6.1f} s  for the {arguments.runs - before} that were left')
        finally:
            for node in nodes:
                node.kill()
        return 0 if check(killed, local, planned) else 1


if __name__ == '__main__':
    sys.exit(main())
