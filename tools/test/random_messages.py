# SPDX-License-Identifier: Apache-2.0
"""Messages as nobody should send them: random, broken, and almost right."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib import import_module
import json
from random import Random
import re
from typing import Any

import msgspec
from viser_client import camera_message

__all__ = ['page_messages', 'ros_message', 'viser_messages']

NUMBERS = (
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-300,
    1e6,
    1e38,
    -1e308,
    *map(float, ('nan', 'inf', '-inf')),
)
TEXTS = (
    '',
    'base_link',
    '/odd//name/',
    'rgb8',
    '32FC1',
    'bayer_rggb8',
    'jpeg',
    'é\n"<b>',
    'x' * 999,
)
SEQUENCE = re.compile(r'^(?:sequence<(?P<bounded>.+?)(?:, \d+)?>|(?P<array>.+)\[(?P<size>\d+)\])$')
INTEGER = re.compile(r'^(?P<unsigned>u?)int(?P<bits>\d+)$')


def ros_message(kind: type, chance: Random, depth: int = 0) -> Any:
    """Return a message of a type, of which hardly anything fits the rest."""
    message = kind()
    for name, field in kind.get_fields_and_field_types().items():  # type: ignore[attr-defined]
        if name == 'frame_id' and chance.random() < 0.8:
            message.frame_id = 'base_link'  # else hardly anything would be looked at
        elif chance.random() < 0.8:
            setattr(message, name, _value(field, chance, depth))
    return message


def _value(field: str, chance: Random, depth: int) -> Any:
    """Return a value for a field of a type, such as `sequence<double>`."""
    many = SEQUENCE.match(field)
    if many:
        return _values(many['bounded'] or many['array'], many['size'], chance, depth)
    whole = INTEGER.match(field)
    if whole:
        return _whole(int(whole['bits']), bool(whole['unsigned']), chance)
    simple: dict[str, Callable[[], Any]] = {
        'boolean': lambda: chance.random() < 0.5,
        'octet': lambda: chance.randbytes(1),
        'float': lambda: max(-3e38, min(3e38, chance.choice(NUMBERS))),
        'double': lambda: chance.choice(NUMBERS),
        'string': lambda: chance.choice(TEXTS),
        'wstring': lambda: chance.choice(TEXTS),
    }
    if field in simple:
        return simple[field]()
    package, _, name = field.partition('/')
    kind = getattr(import_module(f'{package}.msg'), name)
    return ros_message(kind, chance, depth + 1)


def _values(field: str, size: str | None, chance: Random, depth: int) -> Any:
    if size is None and field in ('uint8', 'int8', 'octet'):
        return chance.randbytes(chance.randrange(2000)) if field == 'uint8' else []
    count = int(size) if size else chance.randrange(5 if depth < 3 else 1)
    return [_value(field, chance, depth + 1) for _ in range(count)]


def _whole(bits: int, is_unsigned: bool, chance: Random) -> int:
    least, most = (0, 2**bits - 1) if is_unsigned else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    return chance.choice((0, 1, 2, 7, 12, 100, least, most, chance.randint(least, most)))


def thing(chance: Random, depth: int = 0) -> Any:
    """Return anything that JSON has."""
    kinds = 7 if depth < 3 else 5
    return (
        lambda: None,
        lambda: chance.choice(NUMBERS),
        lambda: chance.choice((0, -1, 2**31, 2**63 - 1, True, False)),
        lambda: chance.choice(TEXTS),
        lambda: chance.choice(('beat', 'stop?', 'drive', 'choose', '/rosout', 'value')),
        lambda: [thing(chance, depth + 1) for _ in range(chance.randrange(4))],
        lambda: {chance.choice(TEXTS[:4]): thing(chance, depth + 1) for _ in range(2)},
    )[chance.randrange(kinds)]()


def viser_messages(chance: Random, widgets: list[str]) -> Iterator[bytes | str]:
    """Yield what no browser sends to viser; `widgets` are the ids of those that there are."""
    while True:
        camera = {**camera_message(), chance.choice([*camera_message()]): thing(chance)}
        value = {'value': thing(chance), **({'visible': False} if chance.random() < 0.2 else {})}
        update = {'type': 'GuiUpdateMessage', 'uuid': chance.choice(widgets), 'updates': value}
        message = chance.choice((camera, update, update, thing(chance), {'type': thing(chance)}))
        whole = msgspec.msgpack.encode(message)
        yield chance.choice(
            (whole, whole, whole[: chance.randrange(len(whole))], chance.randbytes(30), 'text')
        )


def page_messages(chance: Random, actions: tuple[str, ...]) -> Iterator[bytes | str]:
    """Yield what no small page sends."""
    names = 'share press node name text topic service request on'.split()
    while True:
        message = {'do': chance.choice(actions), **{each: thing(chance) for each in names}}
        message['stick'] = [chance.choice((0.5, 10**400, thing(chance))) for _ in range(3)]
        text = json.dumps(chance.choice((message, message, message, thing(chance))))
        yield chance.choice((text, text, text, text[:-1], '[' * 50_000, chance.randbytes(30)))
