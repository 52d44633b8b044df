# SPDX-License-Identifier: Apache-2.0
"""The events of lifecycle nodes and their handlers, without any node."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from launch import LaunchContext
from launch_ros.actions import LifecycleTransition, Node
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
import launch_ros.events.lifecycle
from launch_ros.events.lifecycle import ChangeState, StateTransition
import pytest


def _event(action: Any = None, **labels: str) -> StateTransition:
    """Return an event as a node's message makes it."""
    all_labels = {'transition': 't', 'start_state': 's', 'goal_state': 'g', **labels}
    parts = {name: SimpleNamespace(label=label) for name, label in all_labels.items()}
    return StateTransition(action=action, msg=SimpleNamespace(timestamp=5, **parts))


def test_what_a_transition_tells() -> None:
    """The labels and the time of the message are attributes."""
    event = _event('it')
    assert (event.action, event.transition, event.timestamp) == ('it', 't', 5)
    assert (event.start_state, event.goal_state) == ('s', 'g')


@pytest.mark.parametrize(
    'wanted, is_meant',
    [
        ({}, True),
        ({'goal_state': 'active'}, True),
        ({'goal_state': 'inactive'}, False),
        ({'start_state': 'activating', 'goal_state': 'active'}, True),
        ({'start_state': 'configuring', 'goal_state': 'active'}, False),
        ({'transition': 'activate'}, True),
        ({'transition': 'configure'}, False),
        ({'matcher': lambda event: False}, False),
    ],
)
def test_which_transitions_are_meant(wanted: Any, is_meant: bool) -> None:
    """All that is given must fit; what is left out may be anything."""
    event = _event(transition='activate', start_state='activating', goal_state='active')
    assert OnStateTransition(entities=[], **wanted).matches(event) is is_meant
    assert not OnStateTransition(entities=[], **wanted).matches(object())


def test_target() -> None:
    """A handler of one node does not react to others."""
    node: Any = object()
    handler = OnStateTransition(target_lifecycle_node=node, entities=[])
    assert handler.matches(_event(node)) and not handler.matches(_event(object()))


def test_matcher_decides_alone() -> None:
    """A matcher together with conditions is refused."""
    with pytest.raises(ValueError, match='either a matcher or'):
        OnStateTransition(entities=[], matcher=lambda event: True, goal_state='active')


def test_misspelt_state(capfd: pytest.CaptureFixture[str]) -> None:
    """A state that no node has is reported, with what was probably meant."""
    OnStateTransition(entities=[], goal_state='Activ')
    OnStateTransition(entities=[], start_state='activating', goal_state='active')
    out = capfd.readouterr().out
    assert out.count('OnStateTransition') == 1
    assert "the state 'Activ', which lifecycle nodes do not have: did you mean 'active'?" in out


@pytest.mark.parametrize('transition_id', [-1, 9, 97, 'configure', None])
def test_invalid_transition(transition_id: Any) -> None:
    """An id that cannot be asked for is an error that lists those that can."""
    with pytest.raises(ValueError, match=r'1 \(TRANSITION_CONFIGURE\), 2'):
        ChangeState(lifecycle_node_matcher=lambda node: True, transition_id=transition_id)


def test_ids_are_those_of_the_messages() -> None:
    """The names and ids of the transitions are those of lifecycle_msgs."""
    messages = pytest.importorskip('lifecycle_msgs.msg')
    for number, name in ChangeState.valid_transitions.items():
        assert getattr(messages.Transition, name) == number


def test_names_of_nodes(context: LaunchContext) -> None:
    """A node is found by its full name, with or without the slash in front."""
    node = Node(executable='/bin/true', name='n', namespace='a')
    node.prepare(context)
    assert matches_node_name('/a/n')(node) and matches_node_name('a/n')(node)
    assert not matches_node_name('n')(node)


def test_older_place_of_the_matcher(context: LaunchContext) -> None:
    """The older place works and says where the newer one is."""
    node = Node(executable='/bin/true', name='n', namespace='')
    node.prepare(context)
    with pytest.warns(UserWarning, match='from launch_ros.events instead'):
        assert launch_ros.events.lifecycle.matches_node_name('/n')(node)


@pytest.mark.parametrize('names, ids', [([], [1]), ('n', [1]), (['n'], [])])
def test_empty_chain(names: Any, ids: Any) -> None:
    """There must be nodes and transitions."""
    with pytest.raises(ValueError, match='a list of at least one'):
        LifecycleTransition(lifecycle_node_names=names, transition_ids=ids)


def test_transition_that_leads_nowhere(context: LaunchContext) -> None:
    """Creating and destroying are not parts of a chain."""
    action = LifecycleTransition(lifecycle_node_names=['n'], transition_ids=[8])
    with pytest.raises(ValueError, match='id 8 cannot be part of a chain'):
        action.execute(context)
