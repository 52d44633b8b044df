# SPDX-License-Identifier: Apache-2.0
"""
Measure what the whole bring-up costs while the robot stands and nobody has the page open.

`make bench ARGS='--runs 5'`, or with another built workspace, in turn with this one:

    python3 tools/benchmarks/bringup_cost.py --against /other/workspace --rates

CPU is user and system time of all processes of the launch, in seconds a simulated second, least
of the runs; memory is PSS, which counts what processes share once. `--rates` also prints how
often each topic is published, as one hears it who subscribes to all of them.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from arguments import built_workspace
from bringup_run import measured_run, Run

HERE = Path(__file__).resolve().parents[2]


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--runs', type=int, default=3, help='runs of each workspace')
    parser.add_argument('--seconds', type=float, default=20.0, help='simulated, of each run')
    parser.add_argument(
        '--against', type=built_workspace, help='the folder of another built workspace'
    )
    parser.add_argument('--rates', action='store_true', help='print the rates of all topics')
    options = parser.parse_args()
    workspaces = [HERE] if options.against is None else [HERE, options.against]
    runs: list[list[Run]] = [[] for _ in workspaces]
    for _ in range(options.runs):
        for place, workspace in enumerate(workspaces):
            runs[place].append(measured_run(workspace, options.seconds, options.rates))
    print(f'least of {options.runs} runs of {options.seconds:g} simulated seconds each')
    for workspace, measured in zip(workspaces, runs):
        print_costs(workspace, measured)
    if len(runs) == 2:
        print_ratio(*runs)
    if options.rates:
        print_rates(workspaces, runs)


def print_costs(workspace: Path, runs: list[Run]) -> None:
    """
    Print CPU and memory of each process of a workspace, in the run with the least CPU.

    Parameters
    ----------
    workspace
        Its folder, used as the heading of the table.
    runs
        The measurements of that workspace.

    """
    best = min(runs, key=lambda run: run.total_cpu)
    print(f'\n{"CPU %":>7} {"MB":>6}  {workspace}')
    for name, cost in sorted(best.costs.items(), key=lambda item: -item[1].cpu):
        print(f'{cost.cpu:7.1%} {cost.memory_mb:6.1f}  {name}')
    print(f'{best.total_cpu:7.1%} {best.total_mb:6.1f}  together', flush=True)


def print_ratio(here: list[Run], there: list[Run]) -> None:
    """
    Print the ratios of the least CPU and the least memory of two workspaces.

    Parameters
    ----------
    here, there
        The runs of this workspace, and of the other one.

    """
    cpu = min(run.total_cpu for run in here) / min(run.total_cpu for run in there)
    memory = min(run.total_mb for run in here) / min(run.total_mb for run in there)
    print(f'\n{cpu:7.2f} {memory:6.2f}  of what the other one takes')


def print_rates(workspaces: list[Path], runs: list[list[Run]]) -> None:
    """
    Print the rates of all topics in the last runs, a column for each workspace.

    Parameters
    ----------
    workspaces
        Their folders.
    runs
        The runs of each of them, measured with rates.

    """
    rates = [measured[-1].rates_hz for measured in runs]
    print('\n' + ' '.join(f'{"1/s":>8}' for _ in workspaces) + '  topic, by simulated time')
    for topic in sorted(set().union(*rates)):
        print(' '.join(f'{each.get(topic, 0.0):8.1f}' for each in rates) + f'  {topic}')


if __name__ == '__main__':
    main()
