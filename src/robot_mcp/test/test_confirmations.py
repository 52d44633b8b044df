# SPDX-License-Identifier: Apache-2.0
"""Codes that let a single call happen."""

from __future__ import annotations

from robot_mcp.confirmations import Confirmations, request_of

GO, TURN = request_of('go_to', {'target': 'desk'}), request_of('turn', {'direction': 'left'})


def test_a_code_is_good_once_for_one_request() -> None:
    """Not for another request, and not again; small letters will do."""
    codes = Confirmations()
    code = codes.ask(GO)
    assert not codes.redeem(code, TURN)
    assert codes.redeem(f' {code.lower()} ', GO) and not codes.redeem(code, GO)


def test_a_newer_code_replaces_the_one_before() -> None:
    """So that guesses do not add up."""
    codes = Confirmations()
    old, new = codes.ask(GO), codes.ask(GO)
    assert not codes.redeem(old, GO) and codes.redeem(new, GO)


def test_codes_end() -> None:
    """After some minutes, after three guesses, by a stop, and when there are too many."""
    now = [0.0]
    codes = Confirmations(lambda: now[0])
    code = codes.ask(GO)
    now[0] = 181.0
    assert not codes.redeem(code, GO)
    code = codes.ask(GO)
    assert not any(codes.redeem('WRONG!', GO) for _ in range(3)) and not codes.redeem(code, GO)
    code = codes.ask(GO)
    codes.forget()
    assert not codes.redeem(code, GO)
    code = codes.ask(GO)
    for number in range(8):
        codes.ask(str(number))
    assert not codes.redeem(code, GO)


def test_codes_are_random() -> None:
    """A thousand of them differ."""
    codes = Confirmations()
    assert len({codes.ask(GO) for _ in range(1000)}) == 1000
    assert not codes.redeem('', GO) and not codes.redeem('é', GO)
