# SPDX-License-Identifier: Apache-2.0
"""A bad network between two machines, which are network namespaces.

    python3 bad_link.py NAMESPACE/ADDRESS NAMESPACE/ADDRESS [--delay S] [--loss SHARE] [--unicast]

Packets arrive late by the delay, the given share of them is lost, and with `--unicast` all that go
to a group. SIGUSR1 cuts the link, SIGUSR2 mends it, and SIGTERM ends the program. The kernel's own
means for this (`tc qdisc ... netem`) is missing in many kernels of virtual machines; this needs
only /dev/net/tun, and root.
"""

from __future__ import annotations

import argparse
from collections import deque
from contextlib import suppress
import ctypes
import fcntl
import os
import random
import select
import signal
import struct
import subprocess
import sys
import time

DEVICE = 'bad0'
NETMASK_BITS = 24
SET_INTERFACE = 0x400454CA  # TUNSETIFF
WITHOUT_HEADER = 0x0001 | 0x1000  # IFF_TUN, IFF_NO_PI
NEW_NETWORK = 0x40000000  # CLONE_NEWNET
PACKET_BYTES = 65536
DESTINATION = slice(16, 20)  # in the header of IPv4
GROUPS = range(224, 240)  # the first numbers of multicast addresses


def open_end(namespace: str, address: str) -> int:
    """
    Make the interface of one machine; return the descriptor that carries its packets.

    Parameters
    ----------
    namespace, address
        The name of the network namespace, and the IPv4 address of the interface.

    """
    folder = os.open(f'/run/netns/{namespace}', os.O_RDONLY)
    if ctypes.CDLL(None, use_errno=True).setns(folder, NEW_NETWORK):
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number), namespace)
    os.close(folder)
    device = os.open('/dev/net/tun', os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(device, SET_INTERFACE, struct.pack('16sH', DEVICE.encode(), WITHOUT_HEADER))
    for words in (
        ['addr', 'add', f'{address}/{NETMASK_BITS}', 'dev', DEVICE],
        ['link', 'set', DEVICE, 'up', 'multicast', 'on'],
        ['route', 'add', 'default', 'dev', DEVICE],
    ):
        subprocess.run(['ip', *words], check=True)
    return device


class BadLink:
    """
    Carries packets between two descriptors, late and not all of them.

    Parameters
    ----------
    ends
        The two descriptors.
    delay_s
        How late a packet arrives, in s.
    loss
        The share of the packets that are lost, 0 to 1.
    is_unicast
        Whether multicast is lost.

    """

    def __init__(
        self, ends: tuple[int, int], delay_s: float, loss: float, *, is_unicast: bool
    ) -> None:
        self.is_cut = False
        self._is_unicast = is_unicast
        self._other = {ends[0]: ends[1], ends[1]: ends[0]}
        self._delay_s = delay_s
        self._loss = loss
        self._random = random.Random(1)  # the same losses in each run
        self._under_way: deque[tuple[float, int, bytes]] = deque()

    def run(self) -> None:
        """Carry packets until the process ends."""
        while True:
            wait_s = self._under_way[0][0] - time.monotonic() if self._under_way else None
            ready, _, _ = select.select(self._other, [], [], wait_s and max(0.0, wait_s))
            for end in ready:
                self._take(end)
            while self._under_way and self._under_way[0][0] <= time.monotonic():
                _, end, packet = self._under_way.popleft()
                with suppress(BlockingIOError):  # a full interface loses packets, too
                    if not self.is_cut:
                        os.write(end, packet)

    def _take(self, end: int) -> None:
        packet = os.read(end, PACKET_BYTES)
        is_lost = self._random.random() < self._loss
        is_lost |= self._is_unicast and packet[DESTINATION][0] in GROUPS
        if not self.is_cut and not is_lost:
            self._under_way.append((time.monotonic() + self._delay_s, self._other[end], packet))


def main() -> None:
    """Make the link, and carry packets until a signal ends the process."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('machines', nargs=2, metavar='NAMESPACE/ADDRESS')
    parser.add_argument('--delay', type=float, default=0.0, help='in s')
    parser.add_argument('--loss', type=float, default=0.0, help='0 to 1')
    parser.add_argument('--unicast', action='store_true', help='lose multicast')
    options = parser.parse_args()
    first, second = (open_end(*each.split('/')) for each in options.machines)
    link = BadLink((first, second), options.delay, options.loss, is_unicast=options.unicast)
    signal.signal(signal.SIGUSR1, lambda *_: setattr(link, 'is_cut', True))
    signal.signal(signal.SIGUSR2, lambda *_: setattr(link, 'is_cut', False))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: sys.exit(0))
    print('The link is up', flush=True)
    link.run()


if __name__ == '__main__':
    main()
