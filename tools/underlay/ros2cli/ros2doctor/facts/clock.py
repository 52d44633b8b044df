# SPDX-License-Identifier: Apache-2.0
"""The nodes that use the time of the topic /clock."""

from __future__ import annotations

from collections.abc import Iterable
import time
from typing import Any

TOPIC = '/clock'
PARAMETER = 'use_sim_time'
ANSWER_TIME_S = 1.0
MOST_NODES = 50
PERIOD_S = 0.05


def nodes_on_clock(node: Any, candidates: Iterable[str]) -> tuple[str, ...]:
    """
    Find the nodes whose parameter use_sim_time is true, by their parameter services.

    All are queried at the same time, which takes a second at most; those that have not answered by
    then are left out.

    Parameters
    ----------
    node
        The `DirectNode` that calls the services.
    candidates
        Full names of the nodes to query; only the first 50 by name are.

    Returns
    -------
    tuple of str
        Their full names, sorted.

    """
    from rcl_interfaces.srv import GetParameters

    names = sorted(set(candidates))[:MOST_NODES]
    clients = {name: node.create_client(GetParameters, f'{name}/get_parameters') for name in names}
    answers: dict[str, Any] = {}
    end = time.monotonic() + ANSWER_TIME_S
    try:
        while not _all_done(answers, names) and time.monotonic() < end:
            for name, client in clients.items():
                if name not in answers and client.service_is_ready():
                    request = GetParameters.Request(names=[PARAMETER])
                    answers[name] = client.call_async(request)
            node.spin_once(PERIOD_S)
        return tuple(name for name in names if _is_true(answers.get(name)))
    finally:
        for client in clients.values():
            node.destroy_client(client)


def _all_done(answers: dict[str, Any], names: list[str]) -> bool:
    return len(answers) == len(names) and all(each.done() for each in answers.values())


def _is_true(answer: Any) -> bool:
    return bool(
        answer is not None
        and answer.done()
        and any(value.bool_value for value in answer.result().values)
    )
