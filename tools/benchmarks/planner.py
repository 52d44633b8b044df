# SPDX-License-Identifier: Apache-2.0
"""
Measure how long the rules of the planner take for a sentence.

The sentences are those of the planner's tests, with and without commas, the commands that have to
be rejected, and a long one with an error at its end. The known world is the apartment.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from statistics import mean, quantiles
import sys
import time

from arguments import in_range
from humanoid_perception.places_file import load_places, places_path
from llm_planner.dialogue import Dialogue
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills, skills_path
from llm_planner.world import base_name, KnownObject, World
import yaml

TESTS = Path(__file__).parents[2] / 'src' / 'llm_planner' / 'test'
KINDS = ('moving', 'looking', 'fetching', 'asking', 'together')
LONG = ' and '.join(['go to the kitchen', 'find the red mug', 'turn left'] * 8) + ' and dance'
MOST_MS = 5.0
THINGS = (
    KnownObject('red_mug_1', 'mug', 'red', 'kitchen_counter', 'kitchen', (1.0, 3.8, 0.85)),
    KnownObject('blue_mug_1', 'mug', 'blue', 'desk', 'bedroom', (3.2, 1.2, 0.77)),
    KnownObject('green_apple_1', 'apple', 'green', 'kitchen_table', 'kitchen', (0.0, 2.0, 0.74)),
)


def main() -> int:
    """Measure and print a table; the status is 1 if a sentence takes longer than it may."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument(
        '--runs', type=in_range(int, 1), default=10, help='how often each sentence is planned'
    )
    options = parser.parse_args()
    planner, world = apartment()
    table = yaml.safe_load((TESTS / 'sentences.yaml').read_text())
    understood = [text for kind in KINDS for text in table[kind]]
    wishes = (TESTS / 'wishes.txt').read_text().splitlines()
    groups = {
        'understood': understood,
        'the same without commas': [text.replace(',', '') for text in understood if ',' in text],
        'refused, asked about': [*table['refused'], *table['asked']],
        'wishes': [text for text in wishes if text and not text.startswith('#')],
        f'one of {len(LONG)} letters': [LONG],
    }
    print(f'{"milliseconds a sentence":<26}{"number":>7}{"mean":>8}{"95 %":>8}{"worst":>8}')
    slowest = 0.0
    for name, sentences in groups.items():
        times = [cost_ms(planner, world, text, options.runs) for text in sentences]
        slowest = max(slowest, *times)
        most = quantiles(times, n=20, method='inclusive')[-1] if len(times) > 1 else times[0]
        print(f'{name:<26}{len(times):>7}{mean(times):>8.2f}{most:>8.2f}{max(times):>8.2f}')
    if slowest > MOST_MS:
        print(f'A sentence takes {slowest:.1f} ms; at most {MOST_MS:g} ms are wanted.')
        return 1
    return 0


def apartment() -> tuple[RulePlanner, World]:
    """Return the planner, and its world model at home."""
    places = load_places(places_path('apartment'))
    surfaces = {base_name(each.name): places.room_at(*each.middle_m) for each in places.surfaces}
    containers = tuple(base_name(each.name) for each in places.surfaces if each.is_container)
    rooms = tuple(sorted({each.name for each in places.rooms}))
    return RulePlanner(load_skills(skills_path(''))), World(
        surfaces, rooms, THINGS, containers=containers
    )


def cost_ms(planner: RulePlanner, world: World, text: str, runs: int) -> float:
    """
    Measure the mean CPU time in ms of planning a sentence, after one run to warm up.

    Parameters
    ----------
    planner
        The rule-based planner.
    world
        Its world model.
    text
        The sentence.
    runs
        The number of counted runs.

    """
    planner.plan(text, world, Dialogue())
    begin_s = time.process_time()
    for _ in range(runs):
        planner.plan(text, world, Dialogue())
    return (time.process_time() - begin_s) / runs * 1e3


if __name__ == '__main__':
    sys.exit(main())
