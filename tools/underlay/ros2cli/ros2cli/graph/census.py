# SPDX-License-Identifier: Apache-2.0
"""Count the DDS participants on this machine, and inspect those that do not answer."""

from __future__ import annotations

from collections.abc import Collection

from ros2cli.graph.holders import find_holders, Holder
from ros2cli.graph.participants import participant_sockets
from ros2cli.rtps.parameters import Address, THIS_HOST

SILENCE_S = 0.4  # after which inspecting all processes costs less than waiting longer
AGAIN_S = 2.0


class Census:
    """
    Counts the DDS participants of a domain on this machine from the kernel's socket table.

    Parameters
    ----------
    domain_id
        The ROS domain ID.

    """

    def __init__(self, domain_id: int) -> None:
        self._domain_id = domain_id
        self._sockets: dict[int, str] = {}
        self._since_s: dict[str, float] = {}
        self._holders: dict[str, Holder | None] = {}
        self._again_s = 0.0

    def take(self, now_s: float, silent: Collection[Address]) -> dict[Address, str] | None:
        """
        Count the participants of other processes on this machine.

        Participants that do not answer for 0.4 s are left out if their process will never answer.

        Parameters
        ----------
        now_s
            The current time of a monotonic clock, in s.
        silent
            The addresses of the last count that have not answered yet.

        Returns
        -------
        dict of Address to str, or None
            The inode of the socket at each address, which distinguishes a participant from a
            later one at the same address; None if they cannot be counted.

        """
        sockets = participant_sockets(self._domain_id)
        if sockets is None:
            return None
        self._sockets = sockets
        self._since_s = {
            inode: self._since_s.get(inode, now_s) for inode in self._sockets.values()
        }
        self._examine(now_s, silent)
        return {
            (THIS_HOST, port): inode for port, inode in sockets.items() if self._may_answer(inode)
        }

    def are_stopped(self, silent: Collection[Address]) -> bool:
        """
        Whether all unresponsive participants are stopped processes, so that waiting is futile.

        Parameters
        ----------
        silent
            The addresses of the participants; False if there are none.

        """
        holders = [self._holders.get(self._sockets.get(port, '')) for _, port in silent]
        return bool(holders) and all(holder and holder.is_stopped for holder in holders)

    def _examine(self, now_s: float, silent: Collection[Address]) -> None:
        """Find the processes of silent participants; recheck excluded ones periodically."""
        inodes = {self._sockets.get(port, '') for _, port in silent} & self._since_s.keys()
        doubtful = {inode for inode in inodes if now_s - self._since_s[inode] >= SILENCE_S}
        if doubtful - self._holders.keys() or now_s >= self._again_s:
            strangers = {inode for inode in self._since_s if not self._may_answer(inode)}
            found = find_holders(doubtful | strangers) if doubtful | strangers else {}
            self._holders = {inode: found.get(inode) for inode in doubtful | strangers}
            self._again_s = now_s + AGAIN_S

    def _may_answer(self, inode: str) -> bool:
        """Whether a socket may belong to a discoverable participant."""
        holder = self._holders.get(inode)
        return holder is None or holder.may_answer
