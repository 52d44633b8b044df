# SPDX-License-Identifier: Apache-2.0
"""Parsing of spoken and typed numbers with units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

__all__ = ['NUMBER_WORDS', 'UNITS', 'jsgf_digits', 'jsgf_of', 'numbers_at']

UNITS = {
    'm': 'metres', 'meter': 'metres', 'meters': 'metres', 'metre': 'metres', 'step': 'steps',
    'deg': 'degrees', 'degree': 'degrees', '°': 'degrees', 's': 'seconds', 'sec': 'seconds',
    'second': 'seconds', 'minute': 'minutes', 'cm': 'centimetres', 'centimeters': 'centimetres',
}  # fmt: skip
_ONES = (
    'zero', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten',
    'eleven', 'twelve', 'thirteen', 'fourteen', 'fifteen', 'sixteen', 'seventeen', 'eighteen',
    'nineteen',
)  # fmt: skip
_TENS = ('twenty', 'thirty', 'forty', 'fifty', 'sixty', 'seventy', 'eighty', 'ninety')
NUMBER_WORDS = {word: float(value) for value, word in enumerate(_ONES)}
NUMBER_WORDS |= {word: 10.0 * value for value, word in enumerate(_TENS, 2)}
_FACTORS = {
    'metres': 1.0, 'centimetres': 0.01, 'steps': 0.3, 'degrees': 1.0, 'seconds': 1.0,
    'minutes': 60.0,
}  # fmt: skip
_UNITS_OF = {
    'metres': ('metres', 'centimetres', 'steps'),
    'degrees': ('degrees',),
    'seconds': ('seconds', 'minutes'),
}
_SPOKEN_UNITS = {
    'metres': 'meters | meter | centimeters | steps | step',
    'degrees': 'degrees | degree',
    'seconds': 'seconds | second | minutes | minute',
}


def numbers_at(tokens: Sequence[str], at: int, unit: str) -> Iterator[tuple[int, float]]:
    """
    Yield the parses of a number, with its unit or without.

    Parameters
    ----------
    tokens, at
        The words, and the index of the first one of the number: `half a metre`, `90`.
    unit
        The target unit: `metres`, `degrees` or `seconds`. Units of the same kind are converted.

    Yields
    ------
    int, float
        The index behind the last word, and the number in that unit.

    """
    read = _number(tokens, at)
    if read is None:
        return
    end, number = read
    if end < len(tokens) and tokens[end] in ('metres', 'metre') and unit == 'metres':
        yield end + 1, number
    elif end < len(tokens):
        said = UNITS.get(tokens[end], tokens[end])
        if said in _UNITS_OF[unit]:
            yield end + 1, number * _FACTORS[said]
    yield end, number


def _number(tokens: Sequence[str], at: int) -> tuple[int, float] | None:
    """Parse a number; return the index behind it, and the number, or None if there is none."""
    if at >= len(tokens):
        return None
    if tokens[at][0].isdigit():
        return at + 1, float(tokens[at])
    if tokens[at] == 'half':
        return at + 1 + any(_says(tokens, at + 1, each) for each in ('a', 'an')), 0.5
    end, total = at, 0.0
    hundreds = _hundreds(tokens, at)
    if hundreds:
        end, total = at + 2, 100.0 * hundreds
        if _says(tokens, end, 'and') and _below_hundred(tokens, end + 1):
            end += 1
    elif tokens[at] in ('a', 'an'):
        return at + 1, 1.0
    if below := _below_hundred(tokens, end):
        end, total = below[0], total + below[1]
    if end > at and _says(tokens, end, 'and', 'a', 'half'):
        end, total = end + 3, total + 0.5
    return (end, total) if end > at else None


def _hundreds(tokens: Sequence[str], at: int) -> int:
    """Parse the number of hundreds at an index: 3 for `three hundred`."""
    if not _says(tokens, at + 1, 'hundred'):
        return 0
    number = 1.0 if tokens[at] == 'a' else NUMBER_WORDS.get(tokens[at], 0.0)
    return int(number) if 0.0 < number < 10.0 else 0


def _below_hundred(tokens: Sequence[str], at: int) -> tuple[int, float] | None:
    """Parse a number such as `sixty five`; return the index behind it, and the number; or None."""
    first = NUMBER_WORDS.get(tokens[at]) if at < len(tokens) else None
    if first is None:
        return None
    ones = NUMBER_WORDS.get(tokens[at + 1], 0.0) if at + 1 < len(tokens) else 0.0
    if first >= 20.0 and 0.0 < ones < 10.0:
        return at + 2, first + ones
    return at + 1, first


def _says(tokens: Sequence[str], at: int, *words: str) -> bool:
    """Check whether the tokens from an index on are some words."""
    end = at + len(words)
    return tuple(tokens[at:end]) == words


def jsgf_of(number: str, unit: str) -> str:
    """
    Build the JSGF rule of a number with its unit.

    Parameters
    ----------
    number
        The name of the rule.
    unit
        `metres`, `degrees` or `seconds`.

    """
    return f'<{number}> = (<digits> | half a | a) ({_SPOKEN_UNITS[unit]});'


def jsgf_digits() -> str:
    """Build the JSGF rule `<digits>`, to which the rules of numbers refer, and its subrules."""
    ones, tens = ' | '.join(_ONES[1:]), ' | '.join(_TENS)
    units = ' | '.join(_ONES[1:10])
    return (
        '<digits> = <below_hundred> | <hundreds> [[and] <below_hundred>];\n'
        f'<below_hundred> = {ones} | ({tens}) [{units}];\n'
        f'<hundreds> = (a | {units}) hundred;'
    )
