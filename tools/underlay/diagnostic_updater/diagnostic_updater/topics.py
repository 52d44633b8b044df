# SPDX-License-Identifier: Apache-2.0
"""Diagnostics of a topic: how often messages are published, and how old they are."""

from __future__ import annotations

from typing import Any

from diagnostic_updater.monitors import (
    FrequencyStatus,
    FrequencyStatusParam,
    TimeStampStatus,
    TimeStampStatusParam,
)
from diagnostic_updater.tasks import CompositeDiagnosticTask
from diagnostic_updater.updater import Updater

__all__ = ['DiagnosedPublisher', 'HeaderlessTopicDiagnostic', 'TopicDiagnostic']


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """
    Watches how often messages without a header are published. Call `tick` for each.

    Parameters
    ----------
    name
        The name of the topic.
    diag
        The updater, to which the task is added.
    freq
        What frequencies are accepted.

    """

    def __init__(self, name: str, diag: Updater, freq: FrequencyStatusParam) -> None:
        super().__init__(f'{name} topic status')
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        self.diag.add(self)

    def tick(self) -> None:
        """Count a message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Begin anew: forget the messages so far."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """
    Watches how often messages are published, and how old they are. Call `tick` for each.

    Parameters
    ----------
    name
        The name of the topic.
    diag
        The updater, to which the task is added. Its node has the clock of the time stamps.
    freq
        What frequencies are accepted.
    stamp
        What ages are accepted.

    """

    def __init__(
        self, name: str, diag: Updater, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp, clock=diag.node.get_clock())
        self.addTask(self.stamp)

    def tick(self, stamp: Any) -> None:  # type: ignore[override]
        """
        Count a message.

        Parameters
        ----------
        stamp
            The stamp of its header, a time of rclpy, or s.

        """
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """
    A publisher that is watched: how often it publishes, and how old its messages are.

    Parameters
    ----------
    pub
        The publisher, of messages with a header.
    diag, freq, stamp
        As for `TopicDiagnostic`.

    """

    def __init__(
        self, pub: Any, diag: Updater, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(pub.topic_name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """
        Count a message and publish it.

        Parameters
        ----------
        message
            The message.

        """
        self.tick(message.header.stamp)
        self.publisher.publish(message)
