# SPDX-License-Identifier: Apache-2.0
"""Failure reason of a tree: the error code and message for the result of a navigation."""

from __future__ import annotations

from nav2_behavior_tree import BehaviorTree

__all__ = ['failure_reason']


def failure_reason(tree: BehaviorTree, names: list[str]) -> tuple[int, str]:
    """
    Get the error code, 0 if unknown, and the error message of a failed tree.

    Parameters
    ----------
    tree
        The tree.
    names
        The blackboard entries with the error codes of actions. The code of the node that failed
        last is used, else the lowest one, as Nav2 documents.

    """
    board, failure = tree.blackboard, tree.failure
    codes = {name: board.get(name, 0) for name in names}
    codes = {name: code for name, code in codes.items() if isinstance(code, int) and code > 0}
    if failure is not None and (failure.code in codes.values() or not codes):
        return failure.code, failure.message
    if codes:
        name = min(codes, key=lambda each: codes[each])
        message = board.get(f'{name.removesuffix("_error_code")}_error_msg', '')
        return codes[name], message or (
            failure.message if failure is not None else f"'{name}' is {codes[name]}."
        )
    return 0, 'The behavior tree failed, and none of its nodes said why.'
