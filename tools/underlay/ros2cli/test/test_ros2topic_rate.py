# SPDX-License-Identifier: Apache-2.0
"""Tests of the measurement of rates, bandwidth and delay."""

from ros2topic.api.subscribing import Backlog
from ros2topic.verb.bw import BandwidthMeter, human_bytes
from ros2topic.verb.delay import DelayMeter
from ros2topic.verb.hz import RateMeter


def test_nothing_to_report_before_two_events() -> None:
    """A single event has no rate."""
    meter = RateMeter(window=10)
    assert meter.report() == ''
    meter.add(1.0)
    assert meter.report() == ''


def test_report_of_steady_events() -> None:
    """The report shows rate, extremes, spread and the number of events."""
    meter = RateMeter(window=10)
    for step in range(6):
        meter.add(step * 0.25)
    assert meter.report() == (
        'average rate: 4.000\n\tmin: 0.250s max: 0.250s std dev: 0.00000s window: 6'
    )


def test_a_clock_that_jumps_back_leaves_nothing_to_report() -> None:
    """What was measured before is forgotten, as the simulation was reset."""
    meter = RateMeter(window=10)
    for now_s in (1.0, 1.5, 0.0):
        meter.add(now_s)
    assert meter.report() == ''
    meter.add(0.5)
    assert meter.report().startswith('average rate: 2.000')


def test_spread_of_uneven_events() -> None:
    """The standard deviation is that of the periods."""
    meter = RateMeter(window=10)
    for now_s in (0.0, 0.1, 0.4):
        meter.add(now_s)
    assert meter.report() == (
        'average rate: 5.000\n\tmin: 0.100s max: 0.300s std dev: 0.10000s window: 3'
    )


def test_silence_is_not_reported_again() -> None:
    """A report without new events is empty."""
    meter = RateMeter(window=10)
    meter.add(0.0)
    meter.add(1.0)
    assert meter.report() != ''
    assert meter.report() == ''


def test_window_forgets_old_periods() -> None:
    """Only the last periods count."""
    meter = RateMeter(window=2)
    for now_s in (0.0, 10.0, 10.5, 11.0):
        meter.add(now_s)
    assert meter.report().startswith('average rate: 2.000\n')


def test_clock_that_goes_back_starts_anew() -> None:
    """A simulation that is reset does not spoil the average."""
    meter = RateMeter(window=10)
    for now_s in (100.0, 101.0, 0.0, 0.5):
        meter.add(now_s)
    assert meter.report().startswith('average rate: 2.000\n')


def test_bandwidth_report() -> None:
    """The bandwidth is the bytes of the window over the time since its first message."""
    meter = BandwidthMeter(window=3)
    assert meter.report(0.0) == ''
    for now_s, size in ((0.0, 9000), (1.0, 10), (1.5, 20), (2.0, 30)):
        meter.add(now_s, size)
    assert meter.report(3.0) == (
        '30 B/s from 3 messages\n\tMessage size mean: 20 B min: 10 B max: 30 B'
    )


def test_units_of_bytes() -> None:
    """Large numbers are shown in thousands and millions."""
    assert [human_bytes(count) for count in (999, 1520, 2_500_000)] == [
        '999 B',
        '1.52 KB',
        '2.50 MB',
    ]


def test_delay_report() -> None:
    """The delays are averaged, and each report needs a new message."""
    meter = DelayMeter(window=2)
    for delay_s in (9.0, 0.1, 0.3):
        meter.add(delay_s)
    assert meter.report() == (
        'average delay: 0.200\n\tmin: 0.100s max: 0.300s std dev: 0.10000s window: 2'
    )
    assert meter.report() == ''


MS = 1_000_000


def times(source_ms: int, received_ms: int) -> dict[str, int]:
    """Return the times that rclpy gives with a message."""
    return {'source_timestamp': source_ms * MS, 'received_timestamp': received_ms * MS}


def test_repeated_messages_are_a_backlog() -> None:
    """What was published before the first message came is not measured, what comes then is."""
    backlog = Backlog()
    assert backlog.has(times(1000, 1300))
    assert backlog.has(times(1010, 1300))
    assert backlog.has(times(1290, 1301))
    assert not backlog.has(times(1300, 1301))
    assert not backlog.has(times(1310, 1311))


def test_prompt_message_is_no_backlog() -> None:
    """A first message that comes at once is measured."""
    backlog = Backlog()
    assert not backlog.has(times(1000, 1001))
    assert not backlog.has(times(2000, 2001))


def test_other_clock_is_not_taken_for_a_backlog_for_ever() -> None:
    """The clock of another machine may be late; after two seconds all is measured."""
    backlog = Backlog()
    assert backlog.has(times(0, 5000))
    assert backlog.has(times(1900, 6900))
    assert not backlog.has(times(2100, 7100))
