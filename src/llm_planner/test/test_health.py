# SPDX-License-Identifier: Apache-2.0
"""What planner and executor say of themselves."""

from __future__ import annotations

from humanoid_common.diagnostics import Level
from llm_planner.health import PlannerHealth, skills_status, work_status


def test_a_failure_of_the_model_is_a_warning_for_a_while() -> None:
    """Then it is only remembered."""
    health = PlannerHealth('openai', 'http://here/v1')
    assert health.status(0.0, has_executor=True).message == 'Planning with a language model'
    health.fail('It did not answer in time.', 100.0)
    status = health.status(110.0, has_executor=True)
    assert status.level == Level.WARN and 'It did not answer in time.' in status.message
    later = health.status(500.0, has_executor=True)
    assert later.level == Level.OK
    assert later.values['last error of the model'] == 'It did not answer in time.'


def test_what_the_planner_does() -> None:
    """By which backend, what is done, and what waits for an answer."""
    health = PlannerHealth('rules', plans=3, command='go to the hall', question='Shall I?')
    status = health.status(0.0, has_executor=True)
    assert status.level == Level.OK and status.message == 'Planning with rules'
    assert status.values == {
        'backend': 'rules', 'plans': 3, 'doing': 'go to the hall',
        'waits for an answer to': 'Shall I?',
    }  # fmt: skip
    assert health.status(0.0, has_executor=False).level == Level.WARN


def test_skills_that_cannot_be_used_are_named() -> None:
    """With the reason; what no robot of this kind can do is no trouble."""
    missing = {'pick': 'Manipulation is not running.', 'go_to': 'Navigation is not running.'}
    status = skills_status(missing, {'go_to', 'wave'})
    assert status.level == Level.WARN and status.message == 'Not available now: go_to'
    assert status.values == missing
    del missing['go_to']
    status = skills_status(missing, {'go_to', 'wave'})
    assert status.level == Level.OK and status.values == missing


def test_what_the_executor_does() -> None:
    """The step that it is at, and why the last plan failed."""
    assert work_status('', '', '').message == 'Waiting for a plan'
    status = work_status('go and wave', 'wave', 'There is a wall.')
    assert status.message == 'Doing: wave'
    assert status.values == {'command': 'go and wave', 'last failure': 'There is a wall.'}
