# SPDX-License-Identifier: Apache-2.0
"""
Compute how far it scales: the tables of docs/explanation/scaling.md.

The inputs are the measured figures, which are read from the tables of
docs/explanation/performance.md; a new measurement there changes the result here, and a test fails
until the page has it. `python3 tools/benchmarks/scaling.py` prints the tables.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
import math
from pathlib import Path
import re

PAGE = Path(__file__).resolve().parents[2] / 'docs' / 'explanation' / 'performance.md'
NUMBER = re.compile(r'\d+(?:\.\d+)?')
Rows = Mapping[str, Mapping[str, Sequence[float]]]
"""The numbers of each cell, by row and column."""

NODES_OF_A_ROBOT = 3
"""Of the fleet that was measured; each is a process, which is a participant of DDS."""
NODES_OF_A_BRING_UP = 5
ROBOTS = 100
WALKS = 1_000_000
CORES = (2, 64, 1000)
CORES_OF_A_MACHINE = 64
MOST_PROCESSES = 100
"""On one machine and domain: the ports that Fast DDS tries for a new participant."""
WIFI_BYTES_S = 50e6 / 8
"""Assumed: what a Wi-Fi network carries together, in one channel."""
SMALL_SHARE = 0.1
"""Of a core, which a robot may spend on discovery."""


class Fleet:
    """
    What discovery costs fleets of any size, from what was measured with 5 and with 10 robots.

    Each node announces itself periodically: once by multicast, and once to each node that it knows
    on another machine. Whatever else grows with a fleet is extrapolated by the power law through
    both measurements.

    Parameters
    ----------
    tables
        The tables of the page with the measurements.

    """

    def __init__(self, tables: Mapping[str, Rows]) -> None:
        self._few, self._many = tables['5 robots'], tables['10 robots']
        sent, bytes_sent = self._cell('traffic at rest, all that is sent', 'multicast')
        self.announcements_hz = sent / self._addressed(10)
        self.packet_bytes = 1000 * bytes_sent / sent
        fewer, _ = self._cell('traffic at rest, all that is sent', 'server')
        more_cores = self.cores('multicast') - self.cores('server')
        self.packet_cpu_s = more_cores / (sent - fewer)
        """Of a packet, where it is sent and where it arrives."""

    def _cell(self, row: str, way: str, robots: int = 10) -> Sequence[float]:
        """Return the numbers of a cell."""
        return (self._many if robots == 10 else self._few)[row][way]

    def cores(self, way: str) -> float:
        """
        Return the CPU of ten robots at rest, in cores.

        Parameters
        ----------
        way
            The way of discovery.

        """
        return self._cell('CPU of everything, at rest', way)[0]

    @staticmethod
    def _addressed(robots: float) -> float:
        """Count the packets in which each node announces itself once, without a server."""
        nodes = robots * NODES_OF_A_ROBOT
        return nodes * (1 + nodes - NODES_OF_A_ROBOT)

    def sent_hz(self, robots: float) -> float:
        """
        Compute the packets that all robots send a second at rest, without a server.

        Parameters
        ----------
        robots
            The number of robots.

        """
        return self.announcements_hz * self._addressed(robots)

    def received_hz(self, robots: float) -> float:
        """
        Compute the packets that arrive at one robot a second, without a server.

        Parameters
        ----------
        robots
            The number of robots.

        """
        others = (robots - 1) * NODES_OF_A_ROBOT
        return self.announcements_hz * others * (1 + NODES_OF_A_ROBOT)

    def discovery_cores(self, robots: float) -> float:
        """
        Estimate the CPU that announcements take at rest, without a server, in cores a robot.

        Parameters
        ----------
        robots
            The number of robots.

        """
        return self.sent_hz(robots) / robots * self.packet_cpu_s

    def at(self, robots: float, row: str, way: str, index: int = 0) -> float:
        """
        Extrapolate a figure of the table.

        Parameters
        ----------
        robots
            The number of robots.
        row, way, index
            Which number of which cell.

        """
        few, many = (self._cell(row, way, count)[index] for count in (5, 10))
        return many * (robots / 10) ** math.log2(many / few)


def read_tables(text: str) -> dict[str, Rows]:
    """
    Read all tables of a page.

    Parameters
    ----------
    text
        The page, in Markdown.

    Returns
    -------
    dict of str to Rows
        The tables by their first heading, without those that have none.

    """
    found: dict[str, Rows] = {}
    for block in re.findall(r'(?:^\|.*\|\n)+', text, flags=re.MULTILINE):
        heading, _, *lines = [_cells(line) for line in block.splitlines()]
        rows = {name: dict(zip(heading[1:], map(_numbers, cells))) for name, *cells in lines}
        if heading[0]:
            found[heading[0]] = rows
    return found


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip('|').split('|')]


def _numbers(cell: str) -> list[float]:
    return [float(each) for each in NUMBER.findall(cell.replace(',', ''))]


def fleet_table(fleet: Fleet) -> str:
    """
    Format what discovery costs `ROBOTS` robots.

    Parameters
    ----------
    fleet
        What was measured.

    """
    packets, received = fleet.sent_hz(ROBOTS), fleet.received_hz(ROBOTS)
    at_rest, arriving = (
        'traffic at rest, all that is sent',
        'traffic at rest, received by a machine',
    )
    served = [fleet.at(ROBOTS, row, 'server') for row in (at_rest, arriving)]
    served_bytes = fleet.at(ROBOTS, at_rest, 'server', 1) * 1000
    known, adds = (
        'a new node knows all nodes: mean, longest',
        'what it adds to the traffic until then',
    )
    times_s = [fleet.at(ROBOTS, known, way) for way in ('multicast', 'server')]
    added = [fleet.at(ROBOTS, adds, way, 1) * 1000 for way in ('multicast', 'server')]
    server_cpu = fleet.at(ROBOTS, 'CPU of the server', 'server') / 100
    rows = [
        ('a new node knows all nodes after', *(f'{each:.1f} s' for each in times_s)),
        ('a new node adds to the traffic', *(_bytes(each) for each in added)),
        (
            'sent at rest, by all robots',
            f'{packets:,.0f} packets/s, {_bytes(packets * fleet.packet_bytes)}/s',
            f'{served[0]:,.0f} packets/s, {_bytes(served_bytes)}/s',
        ),
        (
            'arrives at each robot',
            f'{received:,.0f} packets/s',
            f'{served[1]:,.0f} packets/s',
        ),
        (
            'CPU of that, for each robot',
            f'{fleet.discovery_cores(ROBOTS):.2f} cores',
            f'{served[0] / ROBOTS * fleet.packet_cpu_s:.3f} cores',
        ),
        (
            'CPU and memory of the server',
            'no server',
            f'{server_cpu:.3f} cores, {_server_mb(fleet):.0f} MB',
        ),
    ]
    return _table([f'{ROBOTS} robots', 'without a server', 'with a server'], rows)


def _server_mb(fleet: Fleet) -> float:
    """Return the memory of the server, in MB."""
    return fleet.at(ROBOTS, 'memory of the server', 'server')


def machines_table(tables: Mapping[str, Rows], fleet: Fleet) -> str:
    """
    Format what it takes to run `ROBOTS` robots, and to listen to them.

    Parameters
    ----------
    tables
        The tables of the page with the measurements.
    fleet
        What was measured.

    """
    cores, memory_mb = (
        tables['process']['all'][column][0] for column in ('CPU of a core', 'memory')
    )
    cores, memory_gb = ROBOTS * cores / 100, ROBOTS * memory_mb / 1000
    by_cores = math.ceil(cores / CORES_OF_A_MACHINE)
    by_ports = math.ceil(ROBOTS * NODES_OF_A_BRING_UP / MOST_PROCESSES)
    heard = ROBOTS / 10 * tables['10 robots']['the joint states, heard by one node']['server'][1]
    mock = ROBOTS / 10 * fleet.cores('server')
    rows = [
        ('their bring-ups, simulated', f'{cores:.0f} cores, {memory_gb:.0f} GB'),
        (
            f'machines of {CORES_OF_A_MACHINE} cores for that',
            f'{by_cores} by the cores, {by_ports} by the processes in one domain',
        ),
        ('as many mock robots that hold their joints', f'{mock:.0f} cores'),
        ('the joint states of all, heard by one node', f'{_bytes(heard * 1000)}/s'),
    ]
    return _table([f'{ROBOTS} robots', 'need'], rows)


def walks_table(costs: Rows) -> str:
    """
    Format what `WALKS` walks of a minute need.

    Parameters
    ----------
    costs
        The costs of a run of a sweep.

    """
    cpu_s, record_s = _cost(costs, 'a walk of a minute'), _cost(costs, 'recording it') / 1000
    walls_s = [max(WALKS * cpu_s / cores, WALKS * record_s) for cores in CORES]
    rows = [
        ('wall time', *(_duration(each) for each in walls_s)),
        (
            f'machines of {CORES_OF_A_MACHINE} cores',
            *(f'{math.ceil(cores / CORES_OF_A_MACHINE)}' for cores in CORES),
        ),
        (
            'the process that records is busy for',
            *(f'{WALKS * record_s / wall_s:.2%}'.replace('%', ' %') for wall_s in walls_s),
        ),
    ]
    return _table([f'{WALKS:,} walks', *(f'{cores} cores' for cores in CORES)], rows)


def results_table(costs: Rows) -> str:
    """
    Format how much CPU `WALKS` walks take, and how large their results are.

    Parameters
    ----------
    costs
        The costs of a run of a sweep.

    """
    rows = [
        ('CPU', f'{WALKS * _cost(costs, "a walk of a minute") / 3600:,.0f} core-hours'),
        ('`runs.jsonl`', _bytes(WALKS * _cost(costs, 'its line in `runs.jsonl`'))),
        ('`runs.parquet`', _bytes(WALKS * _cost(costs, 'its row in `runs.parquet`'))),
        (
            'memory of the process that records',
            _bytes(WALKS * 1000 * _cost(costs, 'memory while the sweep runs')),
        ),
        (
            'table and report, at the end',
            _duration(WALKS * _cost(costs, 'table and report, at the end') / 1000),
        ),
        (
            'to continue an interrupted sweep',
            _duration(WALKS * _cost(costs, 'reading it, when a sweep continues') / 1000),
        ),
    ]
    return _table([f'{WALKS:,} walks of a minute', 'need'], rows)


def limits_table(tables: Mapping[str, Rows], fleet: Fleet) -> str:
    """
    Format where it breaks, with what breaks first on top.

    Parameters
    ----------
    tables
        The tables of the page with the measurements.
    fleet
        What was measured.

    """
    costs = tables['a run of a sweep']
    served = tables['10 robots']['traffic at rest, all that is sent']['server'][1] * 1000 / 10
    wifi = _most(lambda n: fleet.sent_hz(n) * fleet.packet_bytes < WIFI_BYTES_S)
    share = _most(lambda n: fleet.discovery_cores(n) < SMALL_SHARE)
    recorder = _cost(costs, 'a walk of a minute') / (_cost(costs, 'recording it') / 1000)
    robots = [
        (wifi, 'no server, one Wi-Fi channel', 'announcements fill the channel'),
        (
            MOST_PROCESSES // NODES_OF_A_ROBOT,
            'one machine, one domain',
            f'Fast DDS has ports for {MOST_PROCESSES} processes',
        ),
        (
            share,
            'no server, cables',
            f'announcements take more than {SMALL_SHARE:g} cores of each robot',
        ),
        (
            math.floor(WIFI_BYTES_S / served),
            'a server, one Wi-Fi channel',
            'what nodes tell the server fills the channel',
        ),
    ]
    rows = [(f'{most:,} robots', where, why) for most, where, why in sorted(robots)]
    rows.append(
        (f'{recorder:,.0f} cores', 'one sweep', 'the process that records the runs is always busy')
    )
    return _table(['up to', 'with', 'beyond that'], rows)


def _most(fits: Callable[[int], bool]) -> int:
    """Return the largest number that fits."""
    count = 1
    while fits(count + 1):
        count += 1
    return count


def _cost(costs: Rows, row: str) -> float:
    """Return the cost of a run of a sweep."""
    return costs[row]['cost'][0]


def _bytes(count: float) -> str:
    """Format a number of bytes with its unit."""
    for unit, size in (('GB', 1e9), ('MB', 1e6), ('kB', 1e3)):
        if count >= size:
            return f'{_short(count / size)} {unit}'
    return f'{count:.0f} bytes'


def _duration(duration_s: float) -> str:
    """Format a duration with its unit."""
    for unit, size_s in (('days', 86400.0), ('h', 3600.0), ('min', 60.0)):
        if duration_s >= 2 * size_s:
            return f'{_short(duration_s / size_s)} {unit}'
    return f'{duration_s:.0f} s'


def _short(value: float) -> str:
    """Format a number with about two digits."""
    return f'{value:.1f}' if value < 10 else f'{value:.0f}'


def _table(heading: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Format a table of Markdown."""
    first, *others = (f'| {" | ".join(line)} |' for line in (heading, *rows))
    return '\n'.join([first, '|---' * len(heading) + '|', *others])


def all_tables(page: str) -> list[str]:
    """
    Compute all tables.

    Parameters
    ----------
    page
        The page with the measurements, in Markdown.

    """
    tables = read_tables(page)
    fleet = Fleet(tables)
    costs = tables['a run of a sweep']
    return [
        limits_table(tables, fleet),
        fleet_table(fleet),
        machines_table(tables, fleet),
        results_table(costs),
        walks_table(costs),
    ]


def main() -> None:
    """Print the tables."""
    argparse.ArgumentParser(description=(__doc__ or '').strip().split('\n')[0]).parse_args()
    print('\n\n'.join(all_tables(PAGE.read_text())))


if __name__ == '__main__':
    main()
