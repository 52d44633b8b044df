# SPDX-License-Identifier: Apache-2.0
"""Tests of the quality of service of subscriptions."""

import argparse
from types import SimpleNamespace

import pytest
from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy
from ros2topic.api.arguments import add_qos_arguments, POLICIES, PROFILES
from ros2topic.api.qos import choose_qos, matching_qos, POLICY_TYPES

RELIABLE = ReliabilityPolicy.RELIABLE
BEST_EFFORT = ReliabilityPolicy.BEST_EFFORT
LATCHED = DurabilityPolicy.TRANSIENT_LOCAL
VOLATILE = DurabilityPolicy.VOLATILE


def publisher(
    reliability: ReliabilityPolicy,
    durability: DurabilityPolicy = VOLATILE,
) -> SimpleNamespace:
    """Return what the graph tells about a publisher."""
    profile = QoSProfile(depth=1, reliability=reliability, durability=durability)
    return SimpleNamespace(qos_profile=profile)


def parse(*words: str) -> argparse.Namespace:
    """Return the options of a command line."""
    parser = argparse.ArgumentParser()
    add_qos_arguments(parser, 'subscription')
    return parser.parse_args(words)


@pytest.mark.parametrize(
    ('publishers', 'reliability', 'durability'),
    [
        ([], BEST_EFFORT, VOLATILE),
        ([publisher(RELIABLE)], RELIABLE, VOLATILE),
        ([publisher(RELIABLE, LATCHED)], RELIABLE, LATCHED),
        ([publisher(BEST_EFFORT)], BEST_EFFORT, VOLATILE),
    ],
)
def test_profile_follows_publishers(
    publishers: list[SimpleNamespace],
    reliability: ReliabilityPolicy,
    durability: DurabilityPolicy,
) -> None:
    """Publishers that agree are followed, without a notice."""
    profile, notices = matching_qos(publishers)
    assert (profile.reliability, profile.durability) == (reliability, durability)
    assert notices == []


def test_mixed_publishers_get_the_weaker_policy() -> None:
    """Publishers that differ get a profile which connects to all, and a notice each."""
    profile, notices = matching_qos([publisher(RELIABLE, LATCHED), publisher(BEST_EFFORT)])
    assert (profile.reliability, profile.durability) == (BEST_EFFORT, VOLATILE)
    assert [notice.split(',')[0] for notice in notices] == ['Some', 'Some']


def test_options_override_what_publishers_offer() -> None:
    """A single option replaces one policy and leaves the others."""
    args = parse('--qos-reliability', 'best_effort', '--qos-depth', '7')
    profile, _ = choose_qos(args, [publisher(RELIABLE, LATCHED)])
    assert (profile.reliability, profile.durability) == (BEST_EFFORT, LATCHED)
    assert profile.depth == 7


def test_named_profile_is_taken_as_it_is() -> None:
    """A profile by name does not follow the publishers, and stays unchanged itself."""
    profile, _ = choose_qos(
        parse('--qos-profile', 'default', '--qos-depth', '3'), [publisher(BEST_EFFORT, LATCHED)]
    )
    assert (profile.reliability, profile.durability) == (RELIABLE, VOLATILE)
    assert (profile.depth, QoSPresetProfiles.get_from_short_key('default').depth) == (3, 10)


def test_choices_are_those_of_rclpy() -> None:
    """The choices, which are listed without importing rclpy, are all known to it."""
    assert set(PROFILES) <= set(QoSPresetProfiles.short_keys())
    for name, choices in POLICIES.items():
        assert set(choices) == set(POLICY_TYPES[name].short_keys()) - {'unknown'}


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['--qos-profile', 'unknown'], 'argument --qos-profile: invalid choice'),
        (['--qos-history', 'unknown'], 'argument --qos-history: invalid choice'),
        (['--qos-depth', '0'], "'0' is not a whole number above zero"),
        (['--qos-depth', '1000001'], 'a queue of 1000001 messages is too long: at most 1000000'),
        (
            ['--qos-liveliness-lease-duration-seconds', '1e30'],
            '1e30 seconds is too long: at most 1000000000',
        ),
        (['--qos-liveliness-lease-duration-seconds', 'nan'], "'nan' is not a number above zero"),
    ],
)
def test_what_the_middleware_refuses_is_a_usage_error(
    words: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Values that no publisher or subscription can have are refused with the reason."""
    with pytest.raises(SystemExit):
        parse(*words)
    assert reason in capsys.readouterr().err
