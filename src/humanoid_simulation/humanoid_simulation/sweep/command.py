# SPDX-License-Identifier: Apache-2.0
"""Do an experiment of many walks: `ros2 run humanoid_simulation sweep`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
from pathlib import Path
import shlex
import signal
import sys
from types import FrameType
from typing import NoReturn

from humanoid_common.errors import UserError
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.files import folder_argument, replace_file
from humanoid_simulation.sweep import record, report, table
from humanoid_simulation.sweep.engine import Engine
from humanoid_simulation.sweep.experiment import Experiment, load_experiment
from humanoid_simulation.sweep.local_processes import LocalProcesses
from humanoid_simulation.sweep.progress import print_progress
from humanoid_simulation.sweep.ray_cluster import RayCluster
from humanoid_simulation.sweep.record import find_run, read_record, Record
from humanoid_simulation.sweep.separate_process import SeparateProcess
from humanoid_simulation.sweep.sweeping import Sweep
from humanoid_simulation.sweep.version import code_version
from humanoid_simulation.sweep.walk import walk

FALLS_EXIT, PROBLEM_EXIT = 1, 2
_RAY_LOG = 'ray.log'
_INTERRUPTED = 'Interrupted. Finished runs are kept; the same command does the others.'


def main(argv: Sequence[str] | None = None) -> int:
    """
    Do the runs of an experiment that are left, as the command `sweep`.

    Parameters
    ----------
    argv
        Arguments of the command line, without the program; None uses those of the process.

    Returns
    -------
    int
        Exit code: 0; 1 if more runs fell than the experiment allows; 2 if something is wrong; 130
        or 143 after Ctrl-C or SIGTERM, when finished runs are kept.

    """
    arguments = _parser().parse_args(argv)
    before = signal.signal(signal.SIGTERM, _interrupt)
    try:
        if arguments.replay is not None:
            replay(arguments.replay, _folder(arguments))
        return _do(arguments)
    except UserError as error:
        print(error, file=sys.stderr)
        return PROBLEM_EXIT
    except KeyboardInterrupt as error:
        return 128 + (error.args[0] if error.args else signal.SIGINT)
    finally:
        signal.signal(signal.SIGTERM, before)


def _parser() -> argparse.ArgumentParser:
    """Create the parser of the command line."""
    parser = argparse.ArgumentParser(
        prog='sweep',
        description='Do many simulated walks under the conditions of an experiment, in parallel '
        'and as fast as possible. Finished runs are recorded at once and never repeated: after '
        'an interruption, give the same command again.',
    )
    parser.add_argument('experiment', help='its name, such as soak, or YAML file')
    parser.add_argument(
        '--output',
        type=folder_argument,
        help='folder of record, table and report (default: the name of the experiment and _sweep)',
    )
    parser.add_argument(
        '--processes',
        type=_count,
        metavar='N',
        help='how many runs at the same time (default: one for each core, '
        f'{_cores()} here; with --ray, one for each CPU of the cluster)',
    )
    parser.add_argument(
        '--ray',
        type=_address,
        metavar='ADDRESS',
        help='do the runs on a Ray cluster: auto for the one that this machine belongs to, '
        'ray://HOST:10001 for one elsewhere',
    )
    parser.add_argument(
        '--set',
        action='append',
        default=[],
        metavar='KEY=VALUE',
        help='replace a value of the file, as in runs=5 or friction=0.6; may be repeated',
    )
    modes = parser.add_mutually_exclusive_group()
    modes.add_argument(
        '--plan', action='store_true', help='say what there is to do, and do nothing'
    )
    modes.add_argument('--replay', metavar='KEY', help='show a finished run on a page')
    return parser


def _count(text: str) -> int:
    """Parse a number of processes."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number of at least 1.")
    return int(text)


def _address(text: str) -> str:
    """Parse the address of a cluster: without one, Ray would start a cluster of its own."""
    if not text.strip():
        raise argparse.ArgumentTypeError(
            "an empty text is not an address; 'auto' finds the cluster."
        )
    return text


def _cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0))


def _folder(arguments: argparse.Namespace) -> Path:
    """Return the folder of the sweep."""
    return arguments.output or Path(f'{Path(arguments.experiment).stem}_sweep')


def _interrupt(number: int, frame: FrameType | None) -> NoReturn:
    """End like Ctrl-C."""
    raise KeyboardInterrupt(number)


def _do(arguments: argparse.Namespace) -> int:
    """Do the experiment that the arguments name."""
    experiment = load_experiment(arguments.experiment, arguments.set)
    folder, version = _folder(arguments), code_version()
    if arguments.plan:
        print(_plan(experiment, folder, version))
        return 0
    with Record(folder) as finished:
        sweep = Sweep(experiment, finished, version, print_progress(sys.stdout))
        is_to_report = True
        try:
            sweep.run(_engine(arguments, folder, version))
        except KeyboardInterrupt:
            print(f'\n{_INTERRUPTED}', file=sys.stderr)
            raise
        except UserError:
            is_to_report = not finished.remove_if_empty()
            raise
        finally:
            if is_to_report:
                _write(sweep, folder, _replay_command(arguments))
    print(sweep.conclusion(folder))
    if sweep.crashed:
        return PROBLEM_EXIT
    allowed = experiment.falls_allowed * len(experiment.runs)
    return FALLS_EXIT if sweep.summary.not_stood > allowed else 0


def _engine(arguments: argparse.Namespace, folder: Path, version: str) -> Engine:
    """Choose what does the runs."""
    if arguments.ray is None:
        return LocalProcesses(walk, arguments.processes or _cores())
    cluster = RayCluster(walk, arguments.ray, version, arguments.processes)
    # Ray ends its process when it loses the head of the cluster.
    return SeparateProcess(cluster, f'The Ray cluster at {arguments.ray}', folder / _RAY_LOG)


def _plan(experiment: Experiment, folder: Path, version: str) -> str:
    """Describe what there is to do."""
    path = folder / record.NAME
    finished = read_record(path)[0] if path.exists() else {}
    done = sum((version, run.key) in finished for run in experiment.runs)
    simulated_s = sum(run.conditions.seconds for run in experiment.runs)
    varied = ', '.join(experiment.varied) or 'nothing but the seed'
    return (
        f'{experiment.name}: {len(experiment.runs)} runs, {simulated_s:.0f} s of walking; '
        f'{done} are finished, {len(experiment.runs) - done} are left. Varied: {varied}.'
    )


def _replay_command(arguments: argparse.Namespace) -> str:
    """Return the command that shows a run, without its key."""
    words = ['ros2', 'run', 'humanoid_simulation', 'sweep', arguments.experiment]
    if arguments.output:
        words += ['--output', str(arguments.output)]
    return f'{shlex.join(words)} --replay'


def _write(sweep: Sweep, folder: Path, replay_command: str) -> None:
    """Write report and table; without the library for tables, say how to get it."""
    page = sweep.report(replay_command).html()
    replace_file(folder / report.NAME, page.encode())
    try:
        table.write_table(folder / table.NAME, sweep.everything)
    except table.NoParquetError as error:
        print(error, file=sys.stderr)


def replay(key: str, folder: Path) -> NoReturn:
    """
    Replace this process by a launch that shows a finished run on a page.

    Parameters
    ----------
    key
        The key of the run, or its first digits.
    folder
        The folder of the sweep.

    Raises
    ------
    SimulationError
        There is no such run, or `ros2` cannot be started.

    """
    path = folder / record.NAME
    run = find_run(path, key)
    if run.version != code_version():
        print(
            f'The code has changed since this run: it used version {run.version}. The replay may '
            'end differently.',
            file=sys.stderr,
        )
    command = [
        *('ros2', 'launch', 'humanoid_simulation', 'replay.launch.py'),
        *(f'record:={path.resolve()}', f'key:={run.key}'),
        f'hands:={str(run.conditions.get("hands", False)).lower()}',
    ]
    try:
        os.execvp(command[0], command)  # noqa: S606 - no shell is wanted
    except OSError as error:
        raise SimulationError(
            f"'ros2' cannot be started: {error.strerror}. Source the workspace first."
        ) from error


if __name__ == '__main__':
    sys.exit(main())
