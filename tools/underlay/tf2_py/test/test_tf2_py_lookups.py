# SPDX-License-Identifier: Apache-2.0
"""Look-ups in random trees at random times, against matrices."""

from __future__ import annotations

from geometry_msgs.msg import TransformStamped
import numpy as np
import pytest
from tf2_messages import at, numbers, stamped
from tf2_py import BufferCore

TOLERANCE = 1e-9
FRAMES = 14
SAMPLES = 12


def quaternion_product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the product of two quaternions x, y, z, w."""
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


def slerp(first: np.ndarray, last: np.ndarray, fraction: float) -> np.ndarray:
    """Turn by a fraction of the angle between two quaternions, about its axis."""
    turn = quaternion_product(np.append(-first[:3], first[3]), last)
    turn = turn if turn[3] >= 0 else -turn
    length = np.linalg.norm(turn[:3])
    half = np.arctan2(length, turn[3]) * fraction
    axis = turn[:3] / length if length else turn[:3]
    return quaternion_product(first, np.append(axis * np.sin(half), np.cos(half)))


def matrix(translation: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return the 4x4 matrix of a pose."""
    x, y, z, w = q / np.linalg.norm(q)
    result = np.eye(4)
    result[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    result[:3, 3] = translation
    return result


class Tree:
    """A random tree of frames that move or not, in a buffer and as arrays."""

    def __init__(self, seed: int) -> None:
        self.generator = np.random.default_rng(seed)
        self.buffer = BufferCore()
        self.parents = {
            index: int(self.generator.integers(0, index)) for index in range(1, FRAMES)
        }
        self.samples = {index: self.random_samples() for index in self.parents}
        order = [(index, number) for index in self.parents for number in range(SAMPLES)]
        for place in self.generator.permutation(len(order)):
            self.insert(*order[place])

    def random_samples(self) -> list[tuple[float, np.ndarray, np.ndarray]]:
        """Return times with a translation and a quaternion; one that does not move has one."""
        count = 1 if self.generator.random() < 0.3 else SAMPLES
        inner = np.round(self.generator.uniform(100.0, 109.0, count - 1), 6)
        times = [100.0, *np.sort(inner)[: count - 2], 109.0] if count > 1 else [100.0]
        return [(time, *self.random_pose()) for time in times]

    def random_pose(self) -> tuple[np.ndarray, np.ndarray]:
        """Return a translation and a quaternion."""
        quaternion = self.generator.normal(size=4)
        return self.generator.uniform(-1, 1, 3), quaternion / np.linalg.norm(quaternion)

    def insert(self, index: int, number: int) -> None:
        """Give a sample to the buffer, if there is one of that number."""
        samples = self.samples[index]
        if number < len(samples):
            time, translation, quaternion = samples[number]
            message = stamped(
                f'f{self.parents[index]}', f'f{index}', time, translation, quaternion
            )
            take = self.buffer.set_transform
            if len(samples) == 1:
                take = self.buffer.set_transform_static
            take(message, 'test')

    def in_root(self, index: int, time: float) -> np.ndarray:
        """Return the pose of a frame in the root."""
        result = np.eye(4)
        while index:
            result = self.in_parent(index, time) @ result
            index = self.parents[index]
        return result

    def in_parent(self, index: int, time: float) -> np.ndarray:
        """Return the pose of a frame in its parent."""
        samples = self.samples[index]
        if len(samples) == 1:
            return matrix(*samples[0][1:])
        later = next(i for i, sample in enumerate(samples) if sample[0] >= time)
        begin, first, turned = samples[max(later - 1, 0)]
        end, last, to = samples[later]
        fraction = (time - begin) / (end - begin) if end > begin else 0.0
        return matrix(first + (last - first) * fraction, slerp(turned, to, fraction))

    def random_question(self) -> tuple[int, int, float]:
        """Return two frames and a time."""
        target, source = self.generator.integers(0, FRAMES, 2)
        return int(target), int(source), float(np.round(self.generator.uniform(100, 109), 7))


def assert_same(message: TransformStamped, expected: np.ndarray) -> None:
    """Compare a transform with a matrix."""
    values = np.array(numbers(message))
    np.testing.assert_allclose(matrix(values[:3], values[3:]), expected, atol=TOLERANCE)
    assert np.linalg.norm(values[3:]) == pytest.approx(1.0, abs=TOLERANCE)


@pytest.mark.parametrize('seed', range(25))
def test_lookups(seed: int) -> None:
    """A look-up is what the matrices of the links say."""
    tree = Tree(seed)
    for _ in range(20):
        target, source, time = tree.random_question()
        result = tree.buffer.lookup_transform_core(f'f{target}', f'f{source}', at(time))
        expected = np.linalg.inv(tree.in_root(target, time)) @ tree.in_root(source, time)
        assert_same(result, expected)
        assert (result.header.frame_id, result.child_frame_id) == (f'f{target}', f'f{source}')
        assert result.header.stamp == at(time).to_msg()
        assert tree.buffer.can_transform_core(f'f{target}', f'f{source}', at(time)) == (True, '')


@pytest.mark.parametrize('seed', range(10))
def test_lookups_between_two_times(seed: int) -> None:
    """The full look-up goes through the fixed frame."""
    tree = Tree(100 + seed)
    for _ in range(10):
        target, source, source_time = tree.random_question()
        fixed, _, target_time = tree.random_question()
        arguments = (
            f'f{target}', at(target_time), f'f{source}', at(source_time), f'f{fixed}',
        )  # fmt: skip
        above = np.linalg.inv(tree.in_root(target, target_time)) @ tree.in_root(fixed, target_time)
        below = np.linalg.inv(tree.in_root(fixed, source_time)) @ tree.in_root(source, source_time)
        result = tree.buffer.lookup_transform_full_core(*arguments)
        assert_same(result, above @ below)
        assert result.header.stamp == at(target_time).to_msg()
        assert tree.buffer.can_transform_full_core(*arguments) == (True, '')


def test_latest() -> None:
    """Time 0 is the latest time at which all that moves between the frames is known."""
    buffer = BufferCore()
    for time in (1.0, 2.0, 3.0):
        buffer.set_transform(stamped('map', 'odom', time, (time, 0, 0)), 'test')
    for time in (1.5, 2.5):
        buffer.set_transform(stamped('odom', 'base', time, (0, time, 0)), 'test')
    buffer.set_transform_static(stamped('base', 'camera', 0.0, (0, 0, 1)), 'test')
    result = buffer.lookup_transform_core('map', 'camera', at(0))
    assert numbers(result) == pytest.approx([2.5, 2.5, 1, 0, 0, 0, 1])
    assert result.header.stamp == at(2.5).to_msg()
    assert buffer.get_latest_common_time('map', 'camera') == at(2.5)
    # Above the frames that are asked for, other times do not matter.
    assert buffer.lookup_transform_core('map', 'odom', at(0)).header.stamp == at(3).to_msg()
    assert buffer.lookup_transform_core('base', 'camera', at(0)).header.stamp == at(0).to_msg()


def test_a_frame_in_itself() -> None:
    """The answer is no motion, at any time; at time 0, of the latest time."""
    buffer = BufferCore()
    buffer.set_transform(stamped('map', 'odom', 5.0, (1, 2, 3)), 'test')
    result = buffer.lookup_transform_core('odom', 'odom', at(77.0))
    assert numbers(result) == [0, 0, 0, 0, 0, 0, 1]
    assert result.header.stamp == at(77.0).to_msg()
    assert buffer.lookup_transform_core('odom', 'odom', at(0)).header.stamp == at(5).to_msg()


def test_siblings_do_not_need_what_is_above_them() -> None:
    """Two frames below one do not need that frame's place at the time."""
    buffer = BufferCore()
    buffer.set_transform(stamped('map', 'base', 1.0), 'test')
    for time in (5.0, 6.0):
        buffer.set_transform(stamped('base', 'left', time, (time, 0, 0)), 'test')
        buffer.set_transform(stamped('base', 'right', time, (0, time, 0)), 'test')
    result = buffer.lookup_transform_core('left', 'right', at(5.5))
    assert numbers(result)[:3] == pytest.approx([-5.5, 5.5, 0])


def test_reparenting() -> None:
    """A frame may get another parent; between both samples it stays with the former."""
    buffer = BufferCore()
    buffer.set_transform_static(stamped('world', 'table', 0.0, (1, 0, 0)), 'test')
    buffer.set_transform_static(stamped('world', 'hand', 0.0, (0, 5, 0)), 'test')
    buffer.set_transform(stamped('table', 'cup', 1.0, (0, 0, 1)), 'test')
    buffer.set_transform(stamped('hand', 'cup', 2.0, (0, 0, 2)), 'test')
    for time, place in ((1.0, [1, 0, 1]), (1.9, [1, 0, 1]), (2.0, [0, 5, 2]), (0.0, [0, 5, 2])):
        result = buffer.lookup_transform_core('world', 'cup', at(time))
        assert numbers(result)[:3] == pytest.approx(place)


def test_builtin_times() -> None:
    """The stamp of a message serves as time."""
    buffer = BufferCore()
    buffer.set_transform(stamped('map', 'odom', 5.25), 'test')
    assert buffer.can_transform_core('map', 'odom', at(5.25).to_msg())[0]
    with pytest.raises(TypeError, match=r'5\.25 is neither a time nor a duration: use rclpy'):
        buffer.lookup_transform_core('map', 'odom', 5.25)
