# SPDX-License-Identifier: Apache-2.0
"""Machines on one network, made of network namespaces, with counters of what passes over it.

Each machine has an address, a loopback interface, and a /dev/shm of its own, so that nodes of
different machines exchange everything over the network, as on real machines. It needs root.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
import json
import os
from pathlib import Path
import shutil
import signal
import subprocess
import tempfile
import time

BRIDGE = 'bridge0'
MOST_MACHINES = 250
STOP_S = 30.0


@dataclass(frozen=True)
class Traffic:
    """Packets and bytes that have passed, as Ethernet frames on a network."""

    packets: float
    bytes: float

    def __sub__(self, other: Traffic) -> Traffic:
        """Return what has passed since another count."""
        return Traffic(self.packets - other.packets, self.bytes - other.bytes)

    def __truediv__(self, divisor: float) -> Traffic:
        """Return the traffic a second, or that of one of several machines."""
        return Traffic(self.packets / divisor, self.bytes / divisor)


class Machines:
    """
    Machines that are connected by a switch, or one machine alone.

    Parameters
    ----------
    count
        How many, 1 to `MOST_MACHINES`.

    Attributes
    ----------
    addresses
        The IPv4 address of each; that of a machine alone is the loopback address.

    """

    def __init__(self, count: int) -> None:
        self._names = [f'machine{index}-{os.getpid()}' for index in range(count)]
        self._switch = f'switch-{os.getpid()}'
        self._folder = Path(tempfile.mkdtemp(prefix='machines-', dir='/dev/shm'))
        self.addresses = [f'10.231.8.{index + 1}' for index in range(count)]
        try:
            for name in self._names:
                _ip('netns', 'add', name)
                _ip('-n', name, 'link', 'set', 'lo', 'up')
                (self._folder / name).mkdir()
            if count == 1:
                self.addresses = ['127.0.0.1']
            else:
                self._connect()
        except BaseException:
            self.close()
            raise

    def _connect(self) -> None:
        """Connect each machine to the switch by a cable."""
        _ip('netns', 'add', self._switch)
        _ip('-n', self._switch, 'link', 'add', BRIDGE, 'type', 'bridge', 'mcast_snooping', '0')
        _ip('-n', self._switch, 'link', 'set', BRIDGE, 'up')
        for index, (name, address) in enumerate(zip(self._names, self.addresses, strict=True)):
            port = f'port{index}'
            cable = ['link', 'add', 'e0', 'netns', name, 'type', 'veth']
            _ip(*cable, 'peer', 'name', port, 'netns', self._switch)
            _ip('-n', name, 'addr', 'add', f'{address}/24', 'dev', 'e0')
            _ip('-n', name, 'link', 'set', 'e0', 'up')
            _ip('-n', name, 'route', 'add', 'default', 'dev', 'e0')
            _ip('-n', self._switch, 'link', 'set', port, 'master', BRIDGE, 'up')

    def close(self) -> None:
        """Remove the machines; what runs there has ended."""
        for name in (*self._names, self._switch):
            subprocess.run(['ip', 'netns', 'del', name], capture_output=True, check=False)
        shutil.rmtree(self._folder)

    def command(self, machine: int, *words: str) -> list[str]:
        """
        Return the command that runs another one on a machine.

        Parameters
        ----------
        machine
            The index of the machine.
        *words
            The program and its arguments.

        """
        name = self._names[machine]
        script = 'mount --bind "$0" /dev/shm && exec "$@"'
        shared = str(self._folder / name)
        return ['ip', 'netns', 'exec', name, 'sh', '-c', script, shared, *words]

    def sent(self) -> Traffic:
        """Count what the machines have sent; on one machine, what has passed its loopback."""
        if len(self._names) == 1:
            return _counted(self._names[0], 'lo', 'tx')
        return _counted(self._switch, 'port', 'rx')

    def received(self) -> Traffic:
        """Count what has arrived at all machines; a multicast packet arrives at each of them."""
        if len(self._names) == 1:
            return _counted(self._names[0], 'lo', 'rx')
        return _counted(self._switch, 'port', 'tx')


@contextmanager
def connected(count: int) -> Iterator[Machines]:
    """
    Make machines for a `with` block.

    Parameters
    ----------
    count
        How many.

    """
    machines = Machines(count)
    try:
        yield machines
    finally:
        machines.close()


@contextmanager
def running(
    commands: Sequence[Sequence[str]], environment: Mapping[str, str], log: Path
) -> Iterator[list[subprocess.Popen[bytes]]]:
    """
    Run launches during a `with` block, then end them together as Ctrl-C does.

    Parameters
    ----------
    commands
        The programs and their arguments.
    environment
        Their environment variables.
    log
        The file that their output is appended to.

    Yields
    ------
    list of Popen
        The processes.

    """
    started: list[subprocess.Popen[bytes]] = []
    with log.open('ab') as output:
        try:
            for command in commands:
                started.append(
                    subprocess.Popen(
                        command,
                        env=environment,
                        stdin=subprocess.DEVNULL,
                        stdout=output,
                        stderr=output,
                    )
                )
            yield started
        finally:
            for process in started:
                process.send_signal(signal.SIGINT)
            end_s = time.monotonic() + STOP_S
            for process in started:
                try:
                    process.wait(max(0.1, end_s - time.monotonic()))
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()


def _ip(*words: str) -> str:
    """Run a command of iproute2, and return its output."""
    done = subprocess.run(['ip', *words], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(
            f'`ip {" ".join(words)}` has failed: {done.stderr.strip()}. Machines in one need '
            'root, iproute2, and a kernel with network namespaces, veth and bridge.'
        )
    return done.stdout


def _counted(namespace: str, interface: str, direction: str) -> Traffic:
    """Add the counters of all interfaces whose names begin so."""
    links = json.loads(_ip('-n', namespace, '-j', '-s', 'link', 'show'))
    counters = [
        each['stats64'][direction] for each in links if each['ifname'].startswith(interface)
    ]
    return Traffic(
        sum(each['packets'] for each in counters), sum(each['bytes'] for each in counters)
    )
