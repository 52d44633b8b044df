# SPDX-License-Identifier: Apache-2.0
"""
Measure what a sweep costs: its walks, and the process that records them.

The first row is of walks of a minute, as in `soak`, on all cores. The others are of the process
that hands out the runs, records each on the disk and writes table and report at the end. Its runs
are finished at once, by an engine that does not simulate, with invented results: that shows how
large a sweep can become before its one record limits it. In the environment of the
workspace: `tools/in_environment python3 tools/benchmarks/sweep_cost.py`.
"""

from __future__ import annotations

import argparse
from collections.abc import Generator, Sequence
import json
import os
from pathlib import Path
import random
from statistics import mean
import subprocess
from tempfile import TemporaryDirectory
import time
from typing import Any

from arguments import in_range
from humanoid_simulation.sweep import record, table
from humanoid_simulation.sweep.engine import Done
from humanoid_simulation.sweep.experiment import load_experiment
from humanoid_simulation.sweep.record import read_record, Record
from humanoid_simulation.sweep.results import RunResult
from humanoid_simulation.sweep.sweeping import Sweep
from measuring import memory_mb

EXPERIMENT = 'soak'
VERSION = '0123456789abcdef'
LONGEST_M = 12.0


class Instantly:
    """Engine whose runs are finished at once, each with another result."""

    def outcomes(self, runs: Sequence[Any]) -> Generator[Done, None, None]:
        """
        Yield a result for each run.

        Parameters
        ----------
        runs
            The runs.

        """
        draw = random.Random(0).random
        for run in runs:
            result = RunResult(
                outcome='stood',
                survived_s=run.conditions.seconds,
                distance_m=draw() * LONGEST_M,
                largest_tilt_rad=draw(),
                end_x_m=draw() * LONGEST_M,
                end_y_m=draw(),
                end_yaw_rad=draw(),
                phase='double support',
                forward_m_s=draw(),
                left_m_s=draw(),
                turn_rad_s=draw(),
                push_x_ns=draw(),
                push_y_ns=draw(),
                push_s=draw(),
                cpu_s=draw(),
            )
            yield Done(run, result)


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--walks', type=in_range(int, 1), default=8)
    parser.add_argument('--records', type=in_range(int, 1), default=20_000)
    options = parser.parse_args()
    print('| a run of a sweep | cost |\n|---|---|')
    with TemporaryDirectory() as folder:
        print_rows(walks(options.walks, Path(folder) / 'walked'))
        print_rows(records(options.records, Path(folder) / 'recorded'))


def print_rows(rows: dict[str, str]) -> None:
    """
    Print rows of the table.

    Parameters
    ----------
    rows
        What was measured, and the result.

    """
    for name, text in rows.items():
        print(f'| {name} | {text} |', flush=True)


def walks(count: int, folder: Path) -> dict[str, str]:
    """
    Do walks of a minute on all cores, and measure what each costs.

    Parameters
    ----------
    count
        The number of walks.
    folder
        For the results.

    """
    command = ['ros2', 'run', 'humanoid_simulation', 'sweep', EXPERIMENT]
    subprocess.run(
        [*command, '--set', f'runs={count}', '--output', str(folder)],
        stdout=subprocess.DEVNULL,
        check=True,
    )
    lines = (folder / record.NAME).read_text().splitlines()
    cpu_s = mean(json.loads(line)['result']['cpu_s'] for line in lines)
    return {'a walk of a minute': f'{cpu_s:.2f} s of CPU'}


def records(count: int, folder: Path) -> dict[str, str]:
    """
    Record invented runs, and measure what each costs.

    Parameters
    ----------
    count
        The number of runs.
    folder
        For the results; `TMPDIR` chooses the disk.

    """
    before_mb = memory_mb(os.getpid())
    experiment = load_experiment(EXPERIMENT, [f'runs={count}'])
    with Record(folder) as finished:
        sweep = Sweep(experiment, finished, VERSION, lambda line, stays: None)
        wall_s, cpu_s = time.monotonic(), time.process_time()
        sweep.run(Instantly())
        wall_s, cpu_s = time.monotonic() - wall_s, time.process_time() - cpu_s
        memory_kb = (memory_mb(os.getpid()) - before_mb) * 1000
        begin_s = time.monotonic()
        table.write_table(folder / table.NAME, sweep.everything)
        sweep.report('').html()
        end_s = time.monotonic() - begin_s
    begin_s = time.monotonic()
    read_record(folder / record.NAME)
    read_s = time.monotonic() - begin_s
    line, cells = ((folder / each).stat().st_size / count for each in (record.NAME, table.NAME))
    return {
        'recording it': f'{wall_s / count * 1e3:.2f} ms',
        'CPU of recording it': f'{cpu_s / count * 1e3:.2f} ms',
        'memory while the sweep runs': f'{memory_kb / count:.1f} kB',
        'its line in `runs.jsonl`': f'{line:.0f} bytes',
        'its row in `runs.parquet`': f'{cells:.0f} bytes',
        'table and report, at the end': f'{end_s / count * 1e3:.2f} ms',
        'reading it, when a sweep continues': f'{read_s / count * 1e3:.2f} ms',
    }


if __name__ == '__main__':
    main()
