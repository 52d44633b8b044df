# SPDX-License-Identifier: Apache-2.0
"""Robots for the tests: random trees with every kind of joint."""

from __future__ import annotations

import math
import random

KINDS = ('revolute', 'continuous', 'prismatic', 'fixed')


def random_urdf(seed: int, links: int = 15) -> str:
    """Return a tree whose joints have any kind, origin and axis; some mimic earlier ones."""
    chance = random.Random(seed)
    lines = ['<link name="link_0"/>']
    moving: list[str] = []
    for index in range(1, links):
        kind = chance.choice(KINDS)
        name = f'joint_{index}'
        mimic = ''
        if moving and kind != 'fixed' and chance.random() < 0.3:
            mimic = (
                f'<mimic joint="{chance.choice(moving)}" multiplier="{chance.uniform(-2, 2)!r}" '
                f'offset="{chance.uniform(-1, 1)!r}"/>'
            )
        if kind != 'fixed':
            moving.append(name)
        lines += [
            f'<link name="link_{index}"/>',
            f'<joint name="{name}" type="{kind}">',
            f'<parent link="link_{chance.randrange(index)}"/><child link="link_{index}"/>',
            f'<origin xyz="{vector(chance)}" rpy="{vector(chance, 3.1)}"/>',
            f'<axis xyz="{direction(chance)}"/>',
            '<limit lower="-10" upper="10" effort="1" velocity="1"/>',
            f'{mimic}</joint>',
        ]
    return '<robot name="random">' + '\n'.join(lines) + '</robot>'


def vector(chance: random.Random, size: float = 1.0) -> str:
    """Return three random numbers."""
    return ' '.join(repr(chance.uniform(-size, size)) for _ in range(3))


def direction(chance: random.Random) -> str:
    """Return a random axis of length 1."""
    numbers = [chance.uniform(-1.0, 1.0) for _ in range(3)]
    length = math.hypot(*numbers)
    return ' '.join(repr(number / length) for number in numbers)
