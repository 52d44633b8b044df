# SPDX-License-Identifier: Apache-2.0
"""How much a browser draws: less if it is slow, and never more again by itself."""

from __future__ import annotations

__all__ = ['COARSE', 'FULL', 'SIMPLE', 'Quality']

FULL, SIMPLE, COARSE = 0, 1, 2
"""The steps: with cast shadows; without them; and with fewer pixels and a simpler light, too."""

SLOW_HZ = 8.0
PATIENCE_S = 4.0
"""How long it must be slow before it steps down."""
REST_S = 4.0
"""How long it is not judged after a step, which takes effect only after a while."""
LONGEST_GAP_S = 20.0
"""A page that has not reported for longer was hidden or fast, and is judged anew."""

WITHOUT_CARD = 'This browser draws without a graphics card, so shadows are simple.'
TOLD = {
    SIMPLE: 'The page was drawn slowly, so shadows are simple now.',
    COARSE: 'The page was drawn slowly, so the picture is coarser now.',
}


class Quality:
    """
    The quality of the drawing in one browser.

    It steps down when frames have been slow for some seconds. It does not step up, so that it
    cannot alternate; a user can choose a step instead, which then stays.

    Attributes
    ----------
    step
        The step: `FULL`, `SIMPLE` or `COARSE`; `SIMPLE` before `begin`.
    sentence
        Why it is not `FULL`, if it was lowered automatically; otherwise ''.

    """

    def __init__(self) -> None:
        self.step = SIMPLE
        self.sentence = ''
        self._is_chosen = False
        self._slow_since_s: float | None = None
        self._heard_s = self._judged_from_s = float('-inf')

    def begin(self, choice: int | None, reached: int, has_card: bool) -> None:
        """
        Start in a browser, or follow its user.

        Parameters
        ----------
        choice
            The step that the user has chosen; None for an automatic one.
        reached
            The step that was reached before the page was loaded again.
        has_card
            Whether the browser draws with a graphics card.

        """
        self._slow_since_s = None
        self._is_chosen = choice is not None
        self.sentence = ''
        if choice is not None:
            self.step = choice
            return
        self.step = max(reached, FULL if has_card else SIMPLE)
        if self.step == SIMPLE and not has_card:
            self.sentence = WITHOUT_CARD
        elif self.step:
            self.sentence = TOLD[self.step]

    def report(self, rate_hz: float, now_s: float) -> bool:
        """
        Take a measured frame rate; return True if it led to a step.

        Parameters
        ----------
        rate_hz
            The frame rate.
        now_s
            The time in s, of any monotonic clock.

        """
        is_new = now_s - self._heard_s > LONGEST_GAP_S
        self._heard_s = now_s
        if self._is_chosen or self.step == COARSE or now_s < self._judged_from_s:
            return False
        if rate_hz >= SLOW_HZ:
            self._slow_since_s = None
            return False
        if self._slow_since_s is None or is_new:
            self._slow_since_s = now_s
        if now_s - self._slow_since_s < PATIENCE_S:
            return False
        self.step += 1
        self.sentence = TOLD[self.step]
        self._slow_since_s, self._judged_from_s = None, now_s + REST_S
        return True
