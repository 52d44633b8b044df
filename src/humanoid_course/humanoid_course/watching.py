# SPDX-License-Identifier: Apache-2.0
"""What a program does: watched until there is enough, sent readings, and interrupted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
import time

from humanoid_course.observations import (
    FIRST_MESSAGES,
    INTERRUPT_TIMEOUT_S,
    line_pattern,
    Run,
    Stimulus,
)
from humanoid_course.observer import number_field_of, Observer
from humanoid_course.programs import Program

COLD, HOT = 24.5, 25.5
"""Readings just below and just above the threshold of the exercise; whole numbers: 24, 26."""
_START_TIMEOUT_S = 60.0
"""How long a program may take until its first node appears."""
_QUIET_S = 8.0
"""Nothing new is expected when nothing has changed in the graph for so long."""
_SETTLED_S = 1.0
"""The parameters of nodes are read when nothing has changed for so long."""
_LONGEST_S = 90.0
_STEADY_S = 0.5
"""A node that has started is to run at least so long."""


def watch(program: Program, command: str, is_enough: Callable[[Run], bool]) -> Run:
    """
    Watch a program until there is enough or nothing changes, then interrupt it.

    Parameters
    ----------
    program
        The program, which has just started.
    command
        Its command, as a student would type it.
    is_enough
        Whether what was seen so far is enough.

    """
    observer = Observer()
    try:
        run = _observe(program, command, observer, is_enough)
        observer.spin(_STEADY_S, lambda: program.status is not None)
        run = replace(run, status=program.status, output=program.output)
    finally:
        observer.close()  # before anything is killed, which could hold locks of DDS
    return _interrupt(program, run)


def _observe(
    program: Program, command: str, observer: Observer, is_enough: Callable[[Run], bool]
) -> Run:
    """Collect what a program does, until it is enough or nothing new is expected."""
    begin_s = changed_s = time.monotonic()
    last = Run(command)
    parameters: Mapping[str, str] = {}
    asked: tuple[str, ...] = ()
    while True:
        observer.spin(0.1, lambda: program.status is not None)
        graph = observer.graph()
        now_s = time.monotonic()
        run = Run(
            command,
            status=program.status,
            output=program.output,
            nodes=graph.nodes,
            publishers=graph.publishers,
            subscriptions=graph.subscriptions,
            values={topic: tuple(values) for topic, values in observer.values.items()},
            counts=dict(observer.counts),
            parameters=parameters,
        )
        if not run.ran or is_enough(run):
            return run
        if _has_changed(last, run):
            changed_s = now_s
        elif run.nodes != asked and now_s - changed_s > _SETTLED_S:
            parameters, are_complete = observer.parameters(run.nodes)
            asked = run.nodes if are_complete else ()
        last = run
        patience_s = _QUIET_S if run.nodes else _START_TIMEOUT_S
        if now_s - changed_s > patience_s or now_s - begin_s > _LONGEST_S:
            return run


def _has_changed(before: Run, now: Run) -> bool:
    """Whether nodes or topics are new, or a topic has got one of its first messages."""
    graphs = [(each.nodes, each.publishers, each.subscriptions) for each in (before, now)]
    return graphs[0] != graphs[1] or any(
        before.counts.get(topic, 0) < count <= FIRST_MESSAGES
        for topic, count in now.counts.items()
    )


def _interrupt(program: Program, run: Run) -> Run:
    before = program.mark()
    left = program.interrupt(INTERRUPT_TIMEOUT_S) if run.ran else ()
    return replace(run, left=left, last_words=program.since(before))


def stimulate(program: Program, command: str, topic: str) -> Stimulus:
    """
    Send a node readings below and above the threshold, then interrupt it.

    Parameters
    ----------
    program, command
        The node, as for `watch`.
    topic
        The topic to which it is expected to subscribe.

    """
    observer = Observer()
    try:
        run = _observe(program, command, observer, lambda run: bool(run.subscriptions.get(topic)))
        endpoints = run.subscriptions.get(topic, ())
        kind = endpoints[0].kind if endpoints else ''
        seen = Stimulus(run)
        if run.ran and number_field_of(kind):
            seen = _send_both(program, observer, topic, kind)
        observer.spin(_STEADY_S, lambda: program.status is not None)
        run = replace(run, status=program.status, output=program.output)
    finally:
        observer.close()
    return replace(seen, run=_interrupt(program, run))


def _send_both(program: Program, observer: Observer, topic: str, kind: str) -> Stimulus:
    """Send cold readings, then hot ones until there is something new in the output."""
    start = program.mark()
    observer.send(topic, kind, [COLD] * 5, 0.1)
    observer.spin(1.0)
    cold = program.since(start)
    middle = program.mark()
    end_s = time.monotonic() + _QUIET_S
    while time.monotonic() < end_s and program.status is None:
        observer.send(topic, kind, [HOT], 0.3)
        hot = program.since(middle)
        if _patterns(hot) - _patterns(cold):
            break
    hot = program.since(middle)
    return Stimulus(Run(''), kind, COLD, HOT, _lines(cold), _lines(hot))


def _lines(text: str) -> tuple[str, ...]:
    return tuple(line for line in text.splitlines() if line.strip())


def _patterns(text: str) -> set[str]:
    return {line_pattern(line) for line in _lines(text)}
