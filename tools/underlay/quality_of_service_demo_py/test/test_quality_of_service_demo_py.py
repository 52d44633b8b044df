# SPDX-License-Identifier: Apache-2.0
"""The demos: what they log when the quality of service is not kept."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from quality_of_service_demo_py import (
    deadline,
    incompatible_qos,
    lifespan,
    liveliness,
    message_lost_talker,
)
from quality_of_service_demo_py.message_lost_listener import MessageLostListener
from rclpy.duration import Duration


def test_deadline(stage: Any) -> None:
    """Both sides say that a message is late; the talker pauses and goes on."""
    options, talker, listener = stage.start(deadline, '100 --publish-for 0 --pause-for 100000')
    stage.until_logged('[listener]: I heard: "Talker says 0"')
    stage.executor.create_task(deadline.pause_again_and_again, options, talker, listener)
    stage.until_logged(
        '[talker]: Pausing',
        '[talker]: Offered deadline missed - total 1 delta 1',
        '[listener]: Requested deadline missed - total 1 delta 1',
    )


@pytest.mark.parametrize('policy', incompatible_qos.POLICIES)
def test_incompatible_qos(stage: Any, policy: str) -> None:
    """Both sides name the policy; no message comes."""
    stage.start(incompatible_qos, policy)
    name = 'LIVELINESS' if policy.startswith('liveliness') else policy.upper()
    stage.until_logged(
        'Offered incompatible QoS - total 1', 'Requested incompatible QoS - total 1'
    )
    assert stage.log.count(f'last policy: {name}\n') == 2
    assert 'I heard' not in stage.log


def test_lifespan(stage: Any) -> None:
    """Messages are kept for a listener that comes late, as long as the command line says."""
    _, talker, listener = stage.start(lifespan, '60000 --publish-count 3 --history 2')
    assert talker.publisher.qos_profile.lifespan == Duration(seconds=60)
    for _ in range(4):
        talker.publish()
    stage.executor.create_task(listener.start_listening_after, 0.0)
    stage.until_logged('I heard: "Talker says 1"', 'I heard: "Talker says 2"')
    assert 'I heard: "Talker says 0"' not in stage.log and 'says 3' not in stage.log


@pytest.mark.parametrize('policy', ['AUTOMATIC', 'MANUAL_BY_TOPIC'])
def test_liveliness(stage: Any, policy: str) -> None:
    """The listener sees that the talker comes, and that it gives no more signs of life."""
    options, talker, listener = stage.start(
        liveliness, f'300 --policy {policy} --topic-assert-period 50 --kill-publisher-after 1'
    )
    stage.until_logged('Liveliness changed - alive 1 (delta 1), not alive 0 (delta 0)')
    stage.executor.create_task(liveliness.kill_talker, options, talker, listener)
    stage.until_logged('[listener]: Liveliness changed - alive 0')
    if policy == 'MANUAL_BY_TOPIC':
        stage.until_logged('[talker]: Liveliness lost - total 1 delta 1')


def test_lost_messages(stage: Any) -> None:
    """The listener logs how long images take, and how many are lost."""
    listener = MessageLostListener()
    size = message_lost_talker.make_parser().parse_args(['-s', '2']).size
    talker = message_lost_talker.MessageLostTalker(round(size))
    stage.add(listener, talker)
    stage.until(lambda: listener.count_publishers('message_lost_chatter'), 'no talker')
    stage.until(lambda: talker.count_subscribers('message_lost_chatter'), 'no listener')
    talker.publish()
    stage.until_logged('I heard an image. Message single trip latency: [')
    listener.log_lost(SimpleNamespace(total_count=3, total_count_change=2))
    stage.until_logged('new lost messages: 2\n>\tTotal number of messages lost: 3')


@pytest.mark.parametrize(
    ('demo', 'command', 'reason'),
    [
        (deadline, 'soon', "'soon' is not a time in ms"),
        (incompatible_qos, 'colour', "invalid choice: 'colour'"),
        (message_lost_talker, '-s 0', "'0' is not a size in KiB"),
    ],
)
def test_mistakes(
    demo: Any, command: str, reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A sentence names the argument."""
    with pytest.raises(SystemExit):
        demo.make_parser().parse_args(command.split())
    assert reason in capsys.readouterr().err
