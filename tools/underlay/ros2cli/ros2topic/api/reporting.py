# SPDX-License-Identifier: Apache-2.0
"""Print a report about a topic once a second."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from ros2cli.node.waiting import spin_until
from ros2cli.patience import Patience
from ros2topic.api.incompatibility import Incompatibility

PERIOD_S = 1.0


def report_for_ever(
    node: Any, topic: str, report: Callable[[], str], incompatibility: Incompatibility
) -> None:
    """
    Print a report about a topic once a second, endlessly.

    Parameters
    ----------
    node
        The `DirectNode` to spin in between.
    topic
        Full name of the topic, for the message about missing messages.
    report
        Returns the text, or '' if there is nothing new.
    incompatibility
        Checked once per period for nodes that cannot connect.

    """
    patience = Patience(f"messages on '{topic}'")
    while True:
        spin_until(node, time.monotonic() + PERIOD_S)
        incompatibility.check()
        text = report()
        if text:
            print(text)
        else:
            patience.check()
