# SPDX-License-Identifier: Apache-2.0
"""How forces reach a simulator: through a service whose type is looked up while it runs."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from robot_console import wrench_link
from robot_console.wrench_link import WrenchLink
from rviz_common.frames import Pose

SERVICES = [
    ('/simulator/apply_wrench', ['robot_interfaces/srv/ApplyWrench']),
    ('/simulator/reset_simulation', ['simulation_interfaces/srv/ResetSimulation']),
]
FIELDS = ('entity', 'body', 'wrench', 'point', 'duration')


class Answer:
    """A future, which is done once it has a response."""

    response: Any = None

    def done(self) -> bool:
        """Whether there is a response."""
        return self.response is not None

    def result(self) -> Any:
        """Return the response."""
        return self.response

    def exception(self) -> None:
        """Return no error."""


class Client:
    """A client that remembers what it has sent."""

    def __init__(self, name: str) -> None:
        """Begin with nothing."""
        self.srv_name = name
        self.sent: list[tuple[Any, Answer]] = []
        self.is_ready = True

    def service_is_ready(self) -> bool:
        """Whether the server has been found."""
        return self.is_ready

    def call_async(self, request: Any) -> Answer:
        """Remember a request."""
        self.sent.append((request, Answer()))
        return self.sent[-1][1]


class FakeNode:
    """A node in whose graph there is a simulator."""

    def __init__(self) -> None:
        """Begin without clients."""
        self.services = SERVICES
        self.clients: list[Client] = []

    def get_service_names_and_types(self) -> Any:
        """Return the services."""
        return self.services

    def count_services(self, name: str) -> int:
        """Return that all have a server."""
        return 1

    def create_client(self, kind: Any, name: str) -> Client:
        """Return a client."""
        self.clients.append(Client(name))
        return self.clients[-1]

    def destroy_client(self, client: Client) -> None:
        """Forget a client."""
        self.clients.remove(client)


class Request(SimpleNamespace):
    """A request with the fields that are used."""

    fields: tuple[str, ...] = FIELDS

    def __init__(self) -> None:
        """Make it with empty parts."""
        super().__init__(wrench=SimpleNamespace(), duration=SimpleNamespace())

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the fields."""
        return dict.fromkeys(cls.fields, '')


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch) -> FakeNode:
    """Return a node, with a clock that says 7.5 s."""
    clock = SimpleNamespace(clock=SimpleNamespace(sec=7, nanosec=500_000_000))
    topic = SimpleNamespace(take=lambda: [(clock, 0.0)], close=lambda: None)
    monkeypatch.setattr(wrench_link, 'PolledTopic', lambda *_: topic)
    monkeypatch.setattr(
        wrench_link, 'service_class', lambda name: SimpleNamespace(Request=Request)
    )
    return FakeNode()


def linked(node: Any) -> WrenchLink:
    """Return a link that has looked for the simulator."""
    link = WrenchLink(node, '', '')
    link.update()
    return link


def test_a_force_is_sent_and_its_rejection_reported(node: FakeNode) -> None:
    """The duration is split into seconds and nanoseconds."""
    link, failures = linked(node), []
    assert (link.problem, link.now_s) == ('', 7.5)
    arguments = ('', 'torso'), (1.0, 2.0, 3.0), (0.1, 0.2, 0.3), 0.25, failures.append
    link.push(*arguments)
    ((request, answer),) = node.clients[0].sent
    assert (request.entity, request.body) == ('', 'torso')
    force, point = request.wrench.force, request.point
    assert (force.x, force.y, force.z, point.x, point.y, point.z) == (1, 2, 3, 0.1, 0.2, 0.3)
    assert (request.duration.sec, request.duration.nanosec) == (0, 250_000_000)
    link.update()
    assert failures == []
    answer.response = SimpleNamespace(success=False, message='No such body.')
    link.update()
    link.update()
    assert failures == ['No such body.']
    node.clients[0].is_ready = False
    link.push(*arguments)
    assert len(node.clients[0].sent) == 1
    link.close()
    assert node.clients == []


def test_the_pose_of_an_object_is_asked_for(node: FakeNode) -> None:
    """The simulator may not know it."""
    link, poses, failures = linked(node), [], []
    link.ask_pose('mug', poses.append, failures.append)
    link.update()
    client = node.clients[-1]
    ((request, answer),) = client.sent
    assert (client.srv_name, request.entity) == ('/simulator/get_entity_state', 'mug')
    pose = SimpleNamespace(
        position=SimpleNamespace(x=1.0, y=2.0, z=3.0),
        orientation=SimpleNamespace(x=0.0, y=0.0, z=1.0, w=0.0),
    )
    granted = SimpleNamespace(result=1, error_message='')
    answer.response = SimpleNamespace(result=granted, state=SimpleNamespace(pose=pose))
    link.update()
    assert poses == [Pose((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))]
    link.ask_pose('wall', poses.append, failures.append)
    link.update()
    refused = SimpleNamespace(result=101, error_message='It is fixed.')
    node.clients[-1].sent[0][1].response = SimpleNamespace(result=refused)
    link.update()
    assert failures == ['It is fixed.'] and len(poses) == 1


def test_a_service_of_another_kind_is_not_used(
    node: FakeNode, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sentence names what it lacks, and the simulator may be replaced by a better one."""
    monkeypatch.setattr(Request, 'fields', FIELDS[:-2])
    link = linked(node)
    assert link.problem == (
        "The service '/simulator/apply_wrench' is of the type "
        "'robot_interfaces/srv/ApplyWrench', whose request has no duration and no point."
    )
    monkeypatch.setattr(Request, 'fields', FIELDS)
    link._look.hurry()
    link.update()
    assert link.problem == ''
    node.services = []
    link._look.hurry()
    link.update()
    assert 'No simulator is running' in link.problem
    assert node.clients == []
