# SPDX-License-Identifier: Apache-2.0
"""What the recogniser hears as a command to stop is one for the planner, too."""

from __future__ import annotations

from collections.abc import Iterator

from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills, skills_path
from voice_control.grammar_recognizer import STOP_GRAMMAR
from voice_control.jsgf import compile_jsgf
from voice_control.word_network import WordNetwork

PLANNER = RulePlanner(load_skills(skills_path()))
NETWORK = compile_jsgf(STOP_GRAMMAR)


def sentences(network: WordNetwork, state: int = 0, said: str = '') -> Iterator[str]:
    """Yield all sentences of a network without loops."""
    if state in network.finals:
        yield said.strip()
    for word, target in network.arcs[state].items():
        yield from sentences(network, target, f'{said} {word}')


def test_every_sentence_to_stop_stops_the_planner() -> None:
    """Whatever the recogniser's own grammar for it allows."""
    said = list(sentences(NETWORK))
    assert len(said) > 100
    assert [each for each in said if not PLANNER.is_stop(each)] == []
