# SPDX-License-Identifier: Apache-2.0
"""Rendering methods, from the best to the one that works everywhere, and how to fall back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

EGL = 'egl'
OSMESA = 'osmesa'
RAYS = 'rays'
AUTO = 'auto'
CHOICES = (AUTO, EGL, OSMESA, RAYS)

_PLATFORM = 'PYOPENGL_PLATFORM'
_OWN = {
    # mujoco would try any OpenGL that it finds, and not report why that fails.
    'MUJOCO_GL': 'disable',
    # Nothing is to be imported from the current working directory.
    'PYTHONSAFEPATH': '1',
}
_TITLES = {EGL: 'EGL', OSMESA: 'OSMesa', RAYS: 'rays'}
_WAY_OUT = (
    'To install OpenGL on Debian or Ubuntu: `apt install libegl1 libegl-mesa0 libgl1-mesa-dri`, '
    'or `apt install libosmesa6`; then restart the simulator.'
)
_MOST_DEATHS = 3


def methods_of(choice: str) -> tuple[str, ...]:
    """
    List the rendering methods to try for a choice of the user, best first.

    Parameters
    ----------
    choice
        One of `CHOICES`; AUTO stands for all methods.

    """
    return (EGL, OSMESA, RAYS) if choice == AUTO else (choice,)


def environment_of(method: str, environment: Mapping[str, str]) -> dict[str, str]:
    """
    Compose the environment variables of a render process, which select its OpenGL platform.

    Parameters
    ----------
    method
        The rendering method; RAYS needs no platform.
    environment
        The variables of the present process, which are passed on.

    """
    others = {name: value for name, value in environment.items() if name != _PLATFORM}
    return {**others, **_OWN, **({} if method == RAYS else {_PLATFORM: method})}


def title_of(method: str) -> str:
    """
    Return the display name of a rendering method.

    Parameters
    ----------
    method
        One of EGL, OSMESA and RAYS.

    """
    return _TITLES[method]


def success_sentence(method: str, failures: Mapping[str, str]) -> str:
    """
    Compose the log message about the rendering method in use, and why better ones failed.

    Parameters
    ----------
    method
        The method that works.
    failures
        Why each method before it failed, by method.

    """
    reasons = ' '.join(f'{title_of(each)}: {reason}' for each, reason in failures.items())
    if method != RAYS:
        return f'The cameras are rendered by OpenGL with {title_of(method)}. {reasons}'.rstrip()
    if not failures:
        return 'The cameras are rendered by ray casting, in flat colours.'
    return (
        'The cameras are rendered by ray casting, which is slow and in flat colours, because '
        f'there is no OpenGL. {reasons} {_WAY_OUT}'
    )


def give_up_sentence(failures: Mapping[str, str]) -> str:
    """
    Compose the message that the cameras are off because no rendering method works.

    Parameters
    ----------
    failures
        Why each method failed, by method.

    """
    reasons = ' '.join(f'{title_of(each)}: {reason}' for each, reason in failures.items())
    return f'The cameras are off; the simulation continues. {reasons} {_WAY_OUT}'


class Ladder:
    """
    Fallback order of rendering methods, and why those that were tried have failed.

    A method that has rendered before is retried when its process ends, until that happens three
    times without an image in between.

    Parameters
    ----------
    methods : Sequence[str]
        The methods, best first.

    """

    def __init__(self, methods: Sequence[str]) -> None:
        self._methods = list(methods)
        self._deaths = 0
        self._has_drawn = False
        self.failures: dict[str, str] = {}
        """The reason why a method cannot be used, by method."""

    @property
    def method(self) -> str:
        """Return the method to use; '' if none is left."""
        left = [method for method in self._methods if method not in self.failures]
        return left[0] if left else ''

    def note_picture(self) -> None:
        """Record that the method has rendered an image."""
        self._has_drawn = True
        self._deaths = 0

    def note_end(self, reason: str) -> bool:
        """
        Record why a render process ended, and decide whether to try its method again.

        Parameters
        ----------
        reason
            Why it ended, as a sentence; it is kept in `failures` if the method is given up.

        Returns
        -------
        bool
            Whether the same method gets another chance; if not, `method` is the next one.

        """
        self._deaths += 1
        if self._has_drawn and self._deaths < _MOST_DEATHS:
            return True
        self.failures[self.method] = reason
        self._deaths = 0
        self._has_drawn = False
        return False
