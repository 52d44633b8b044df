# SPDX-License-Identifier: Apache-2.0
"""Rotations, quaternions and homogeneous matrices."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest
import tf_transformations as tf

ORDERS = 'xyz xyx xzy xzx yzx yzy yxz yxy zxy zxz zyx zyz'.split()
TURNS = {'x': (1, 0, 0), 'y': (0, 1, 0), 'z': (0, 0, 1)}
ANGLES = (0.4, 0.9, -1.3)


@pytest.mark.parametrize('kind', ['s', 'r'])
@pytest.mark.parametrize('order', ORDERS)
def test_euler_angles_about_all_axes(kind: str, order: str) -> None:
    """Turns about static axes are done in order, those about rotating ones in reverse."""
    turns = [tf.rotation_matrix(angle, TURNS[axis]) for angle, axis in zip(ANGLES, order)]
    expected = functools.reduce(np.matmul, turns if kind == 'r' else turns[::-1])
    assert tf.euler_matrix(*ANGLES, kind + order) == pytest.approx(expected)
    quaternion = tf.quaternion_from_euler(*ANGLES, axes=kind + order)
    assert tf.quaternion_matrix(quaternion) == pytest.approx(expected)
    assert tf.euler_from_quaternion(quaternion, kind + order) == pytest.approx(ANGLES)
    assert tf.euler_from_matrix(expected[:3, :3], kind + order) == pytest.approx(ANGLES)


@pytest.mark.parametrize(
    ('code', 'name'),
    [
        ((0, 0, 0, 0), 'sxyz'),
        ((0, 0, 1, 0), 'sxyx'),
        ((1, 1, 0, 0), 'syxz'),
        ((0, 0, 0, 1), 'rzyx'),
        ((2, 1, 1, 1), 'rzyz'),
    ],
)
def test_axes_as_numbers(code: tuple[int, int, int, int], name: str) -> None:
    """Axes can be the first axis, and whether they are odd, repeated and rotating."""
    assert tf.euler_matrix(*ANGLES, code) == pytest.approx(tf.euler_matrix(*ANGLES, name))


@pytest.mark.parametrize('axes', ['xyz', 'sxxy', 'qxyz', 'sabc', 'sxy'])
def test_axes_that_do_not_exist(axes: str) -> None:
    """They are refused with examples."""
    with pytest.raises(ValueError, match=f"'{axes}' are not axes .* such as sxyz"):
        tf.euler_matrix(*ANGLES, axes)


def test_documented_quaternions() -> None:
    """The order of numbers and the sign are those of the documentation."""
    found = tf.quaternion_from_euler(1, 2, 3, 'ryxz')
    assert found == pytest.approx([0.310622, -0.718287, 0.444435, 0.435953], abs=1e-6)
    yaw = tf.quaternion_from_euler(0, 0, -1.550)
    assert yaw == pytest.approx([0.0, 0.0, -0.69971608, 0.71442103])
    assert tf.quaternion_multiply([1, -2, 3, 4], [-5, 6, 7, 8]).tolist() == [-44, -14, 48, 28]
    assert tf.quaternion_about_axis(0.123, (1, 0, 0)) == pytest.approx(
        [0.06146124, 0, 0, 0.99810947]
    )


def test_quaternions_that_are_no_rotation() -> None:
    """One without length turns nothing; one of another length is that rotation."""
    assert tf.euler_from_quaternion([0, 0, 0, 0]) == (0.0, 0.0, 0.0)
    assert tf.euler_from_quaternion([0, 0, 2, 2]) == pytest.approx((0, 0, math.pi / 2))


def test_rotations_with_more_than_one_solution(recwarn: pytest.WarningsRecorder) -> None:
    """At a pitch of 90 degrees the angles are some that describe the rotation, silently."""
    rotation = tf.euler_matrix(0.3, math.pi / 2, 0.8)
    again = tf.euler_matrix(*tf.euler_from_matrix(rotation))
    assert again == pytest.approx(rotation, abs=1e-6)
    assert not recwarn.list


def test_quaternions_and_their_inverses() -> None:
    """A quaternion times its inverse is nothing; rotations follow each other as matrices do."""
    one, other = tf.random_quaternion(), tf.random_quaternion([0.1, 0.5, 0.9])
    assert tf.vector_norm(one) == pytest.approx(1.0)
    nothing = tf.quaternion_multiply(one * 3.0, tf.quaternion_inverse(one * 3.0))
    assert nothing == pytest.approx([0, 0, 0, 1])
    assert tf.quaternion_conjugate(one) == pytest.approx(tf.quaternion_inverse(one))
    product = tf.quaternion_matrix(tf.quaternion_multiply(one, other))
    assert product == pytest.approx(tf.quaternion_matrix(one) @ tf.quaternion_matrix(other))
    back = tf.quaternion_from_matrix(tf.quaternion_matrix(one))
    assert back == pytest.approx(one if one[3] >= 0 else -one)


def test_interpolation() -> None:
    """Half the way is half the angle; the longer way and more turns are possible."""
    start, end = tf.quaternion_from_euler(0, 0, 0), tf.quaternion_from_euler(0, 0, 1.0)
    half = tf.quaternion_slerp(start, end, 0.5)
    assert tf.euler_from_quaternion(half)[2] == pytest.approx(0.5)
    assert tf.quaternion_slerp(start, -end, 0.5) == pytest.approx(half)
    longer = tf.quaternion_slerp(start, -end, 0.5, shortestpath=False)
    assert abs(tf.euler_from_quaternion(longer)[2]) == pytest.approx(math.pi - 0.5)
    assert tf.quaternion_slerp(start, start, 0.3) == pytest.approx(start)
    assert tf.quaternion_slerp(start, end, 1.0) == pytest.approx(end)


def test_turns_about_an_axis_somewhere() -> None:
    """The axis of a turn is found again, and stays where it is."""
    matrix = tf.rotation_matrix(0.7, [0.0, 3.0, 4.0], [1.0, 2.0, 3.0])
    assert matrix @ [1.0, 2.0, 3.0, 1.0] == pytest.approx([1.0, 2.0, 3.0, 1.0])
    angle, direction, point = tf.rotation_from_matrix(matrix)
    assert angle == pytest.approx(0.7)
    assert direction == pytest.approx([0.0, 0.6, 0.8])
    assert tf.is_same_transform(tf.rotation_matrix(angle, direction, point), matrix)
    assert tf.rotation_from_matrix(np.eye(4))[0] == 0.0


def test_translations_and_products() -> None:
    """The last of the multiplied matrices comes first; the inverse takes it back."""
    move = tf.translation_matrix([1.0, 2.0, 3.0])
    turn = tf.rotation_matrix(math.pi / 2, [0, 0, 1])
    both = tf.concatenate_matrices(move, turn)
    assert both @ [1.0, 0.0, 0.0, 1.0] == pytest.approx([1.0, 3.0, 3.0, 1.0])
    assert tf.translation_from_matrix(both).tolist() == [1.0, 2.0, 3.0]
    assert tf.is_same_transform(both @ tf.inverse_matrix(both), 2.0 * tf.identity_matrix())
    assert not tf.is_same_transform(both, move)


def test_mirrors_scales_and_shears() -> None:
    """Each is found again from its matrix, or does what its name says."""
    mirror = tf.reflection_matrix([0, 0, 2.0], [0, 0, 5.0])
    assert mirror @ [1.0, 1.0, 3.0, 1.0] == pytest.approx([1.0, 1.0, 1.0, 1.0])
    assert tf.is_same_transform(mirror, tf.reflection_matrix(*tf.reflection_from_matrix(mirror)))
    with pytest.raises(ValueError, match='not a reflection'):
        tf.reflection_from_matrix(np.eye(4))
    for origin, direction in ((None, None), ([1, 2, 3], None), ([1, 2, 3], [0, 1, 1])):
        scale = tf.scale_matrix(-1.5, origin, direction)
        factor, fixed, along = tf.scale_from_matrix(scale)
        assert factor == pytest.approx(-1.5)
        assert tf.is_same_transform(tf.scale_matrix(factor, fixed, along), scale)
    with pytest.raises(ValueError, match='not a uniform scaling'):
        tf.scale_from_matrix(np.diag([1.0, 2.0, 3.0, 1.0]))
    shear = tf.shear_matrix(math.pi / 4, [1, 0, 0], [0, 0, 1], [0, 0, 1])
    assert shear @ [0.0, 0.0, 3.0, 1.0] == pytest.approx([2.0, 0.0, 3.0, 1.0])
    with pytest.raises(ValueError, match='perpendicular'):
        tf.shear_matrix(0.1, [0, 0, 1], [0, 0, 0], [0, 0, 1])


def test_parts_of_a_matrix() -> None:
    """Scale, shear, angles, translation and perspective are found again."""
    parts = ((1.5, 2.0, 0.5), (0.1, -0.2, 0.3), (0.4, -0.5, 0.6), (1.0, 2.0, 3.0))
    scale, shear, angles, translation, perspective = tf.decompose_matrix(tf.compose_matrix(*parts))
    for found, expected in zip((scale, shear, angles, translation), parts):
        assert np.array(found) == pytest.approx(expected)
    assert perspective == pytest.approx([0, 0, 0, 1])
    mirrored = tf.compose_matrix((-1.0, -2.0, -3.0), None, (0.1, 0.2, 0.3), (4.0, 5.0, 6.0))
    assert tf.is_same_transform(mirrored, tf.compose_matrix(*tf.decompose_matrix(mirrored)))
    seen = tf.compose_matrix(None, None, (0.1, 0.2, 0.3), None, (0.2, 0.1, 0.3, 1.0))
    assert tf.is_same_transform(seen, tf.compose_matrix(*tf.decompose_matrix(seen)))
    with pytest.raises(ValueError, match='has an inverse'):
        tf.decompose_matrix(np.diag([1.0, 1.0, 0.0, 1.0]))


@pytest.mark.parametrize('scaling', [False, True])
def test_points_onto_others(scaling: bool) -> None:
    """The motion between two sets of points is found, with a scale if that is wanted."""
    points = np.random.default_rng(3).normal(size=(3, 12))
    motion = tf.compose_matrix(angles=ANGLES, translate=(1.0, -2.0, 0.5))
    if scaling:
        motion = tf.concatenate_matrices(motion, tf.scale_matrix(1.7))
    moved = motion[:3, :3] @ points + motion[:3, 3:]
    found = tf.superimposition_matrix(points, moved, scaling=scaling)
    assert tf.is_same_transform(found, motion)
    mirrored = tf.superimposition_matrix(points, -points)
    assert np.linalg.det(mirrored[:3, :3]) == pytest.approx(1.0)


def test_vectors() -> None:
    """Lengths along an axis, and directions."""
    vectors = np.array([[3.0, 4.0], [0.0, 2.0]])
    assert tf.vector_norm(vectors, axis=1).tolist() == [5.0, 2.0]
    assert tf.vector_norm([1.0, 2.0, 2.0]) == 3.0
    assert tf.unit_vector(vectors, axis=1).tolist() == [[0.6, 0.8], [0.0, 1.0]]
    assert tf.unit_vector([0.0, 2.0]).tolist() == [0.0, 1.0]
    assert tf.random_vector(5).shape == (5,)
    rotation = tf.random_rotation_matrix()[:3, :3]
    assert rotation @ rotation.T == pytest.approx(np.eye(3))


def test_shears_are_found_again() -> None:
    """With their angle, plane and direction."""
    shear = tf.shear_matrix(0.7, (1.0, -2.0, 0.0), (0.3, 0.4, 0.5), (2.0, 1.0, 4.0))
    angle, direction, point, normal = tf.shear_from_matrix(shear)
    assert angle == pytest.approx(0.7)
    assert shear @ point == pytest.approx(point)
    assert tf.shear_matrix(angle, direction, point, normal) == pytest.approx(shear)
    for other in (np.eye(4), tf.rotation_matrix(0.5, (1, 0, 0)), tf.scale_matrix(2.0)):
        with pytest.raises(ValueError, match='not a shear'):
            tf.shear_from_matrix(other)


POINT, NORMAL = np.array([0.2, -1.0, 0.7]), np.array([0.0, 0.6, 0.8])


@pytest.mark.parametrize('direction', [None, (0.3, 1.0, 2.0)])
def test_parallel_projections(direction: tuple[float, ...] | None) -> None:
    """Points come to the plane along the direction, and those of the plane stay."""
    matrix = tf.projection_matrix(POINT, NORMAL, direction)
    place = np.array([4.0, 5.0, 6.0])
    shadow = (matrix @ [*place, 1.0])[:3]
    assert (shadow - POINT) @ NORMAL == pytest.approx(0.0)
    assert np.cross(shadow - place, NORMAL if direction is None else direction) == pytest.approx(
        np.zeros(3)
    )
    assert matrix @ [*shadow, 1.0] == pytest.approx([*shadow, 1.0])
    point, normal, along, centre, pseudo = tf.projection_from_matrix(matrix)
    assert centre is None and not pseudo
    assert tf.projection_matrix(point, normal, along) == pytest.approx(matrix)


def test_central_projections() -> None:
    """Points come to the plane along lines through the centre; depth can be kept."""
    centre, place = np.array([0.5, 4.0, 3.0]), np.array([1.0, 0.0, -2.0])
    matrix = tf.projection_matrix(POINT, NORMAL, perspective=centre)
    shadow = matrix @ [*place, 1.0]
    shadow = shadow[:3] / shadow[3]
    assert (shadow - POINT) @ NORMAL == pytest.approx(0.0)
    assert np.cross(shadow - centre, place - centre) == pytest.approx(np.zeros(3), abs=1e-12)
    point, normal, along, found, _ = tf.projection_from_matrix(3.0 * matrix)
    assert along is None and found == pytest.approx(centre)
    assert normal == pytest.approx(NORMAL) and (point[:3] - POINT) @ NORMAL == pytest.approx(0.0)

    deep = tf.projection_matrix(POINT, NORMAL, perspective=centre, pseudo=True)
    assert tf.is_same_transform(tf.projection_matrix(POINT, NORMAL) @ deep, matrix)
    assert np.linalg.matrix_rank(deep) == 4
    point, _, _, found, pseudo = tf.projection_from_matrix(deep, pseudo=True)
    assert pseudo and found == pytest.approx(centre)
    assert (point[:3] - POINT) @ NORMAL == pytest.approx(0.0)


def test_what_is_no_projection_is_said() -> None:
    """A rotation has an inverse."""
    with pytest.raises(ValueError, match='not a projection'):
        tf.projection_from_matrix(tf.rotation_matrix(0.5, (1, 0, 0)))


@pytest.mark.parametrize('perspective', [False, True])
def test_a_volume_is_mapped_to_a_cube(perspective: bool) -> None:
    """Its corners become those of the cube; at the far face of a pyramid they are farther out."""
    bounds = np.array([[-1.0, 2.0], [0.5, 1.5], [2.0, 6.0]])
    matrix = tf.clip_matrix(*bounds.ravel(), perspective=perspective)
    for far in (0, 1):
        for x in (0, 1):
            spread = bounds[2, far] / bounds[2, 0] if perspective else 1.0
            corner = matrix @ [bounds[0, x] * spread, bounds[1, 1] * spread, bounds[2, far], 1.0]
            assert corner / corner[3] == pytest.approx([2.0 * x - 1.0, 1.0, 2.0 * far - 1.0, 1.0])
    with pytest.raises(ValueError, match='left < right'):
        tf.clip_matrix(1, -1, 0, 1, 2, 3)
    with pytest.raises(ValueError, match='near > 0'):
        tf.clip_matrix(-1, 1, -1, 1, 0, 3, perspective=True)


def test_cells_of_crystals() -> None:
    """The edges have their lengths and angles; the sum of the matrix is as documented."""
    lengths, angles = np.array([9.8, 12.0, 15.5]), np.array([87.2, 80.7, 69.7])
    matrix = tf.orthogonalization_matrix(lengths, angles)
    edges = matrix[:3, :3].T
    assert np.linalg.norm(edges, axis=1) == pytest.approx(lengths)
    for angle, (one, other) in zip(angles, [(1, 2), (0, 2), (0, 1)]):
        cosine = edges[one] @ edges[other] / (lengths[one] * lengths[other])
        assert math.degrees(math.acos(cosine)) == pytest.approx(angle)
    assert matrix.sum() == pytest.approx(43.063229)


def test_trackball() -> None:
    """It turns as documented, free and about axes, and goes on turning."""
    ball = tf.Arcball(initial=np.eye(4))
    ball.place([320, 320], 320)
    ball.down([500, 250])
    assert ball.matrix() == pytest.approx(np.eye(4))
    ball.drag([475, 275])
    assert ball.matrix().sum() == pytest.approx(3.90583455)
    once = ball.matrix()
    ball.next()
    assert ball.matrix() == pytest.approx(once @ once)

    ball = tf.Arcball(initial=[0, 0, 0, 1])
    ball.place([320, 320], 320)
    ball.setaxes([1, 1, 0], [-1, 1, 0])
    ball.setconstrain(True)
    assert ball.getconstrain()
    ball.down([400, 200])
    ball.drag([200, 400])
    assert ball.matrix().sum() == pytest.approx(0.2055924)
    _, axis, _ = tf.rotation_from_matrix(ball.matrix())
    assert np.abs(axis) == pytest.approx([0.5**0.5, 0.5**0.5, 0.0], abs=1e-9)
    with pytest.raises(ValueError, match='quaternion or a 4x4 matrix'):
        tf.Arcball([1.0, 2.0])


def test_points_of_the_trackball() -> None:
    """In the window y is downwards; beside the ball it is its outline."""
    assert tf.arcball_map_to_sphere((4, 2), (4, 5), 5) == pytest.approx([0.0, 0.6, 0.8])
    assert tf.arcball_map_to_sphere((14, 5), (4, 5), 5) == pytest.approx([1.0, 0.0, 0.0])
    found = tf.arcball_constrain_to_axis((0.0, 0.6, 0.8), (0.0, 1.0, 0.0))
    assert found == pytest.approx([0.0, 0.0, 1.0])
    assert tf.arcball_constrain_to_axis((0, 0, 1), (0, 0, 1)) == pytest.approx([1.0, 0.0, 0.0])
    assert tf.arcball_constrain_to_axis((0, 1, 0), (0, 1, 0)) == pytest.approx([-1.0, 0.0, 0.0])
    axes = [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0)]
    assert tf.arcball_nearest_axis((0.0, 0.6, 0.8), axes) == pytest.approx([1.0, 0.0, 0.0])
