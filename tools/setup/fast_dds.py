# SPDX-License-Identifier: Apache-2.0
"""Mends a deadlock of Fast DDS in the environment's own copies of its library.

To destroy a node, `DomainParticipant::set_listener` waits without a time-out until no callback of
the participant runs. As the wheels' library is built for glibc 2.28, that is a wait on the system
clock, whose deadline is

    system_now + (deadline - steady_now)

with the largest number of nanoseconds as `deadline`: the sum overflows, glibc refuses the
negative time and returns at once, without releasing the mutex. The thread then asks again for ever
and holds the mutex that the callback waits for (eProsima/Fast-DDS issue 6513). About one node of a
thousand that are destroyed hangs so, with a whole processor and Python's lock.

One instruction is changed: `deadline / 2`, 146 years, takes the place of `deadline - steady_now`.
"""

from __future__ import annotations

from pathlib import Path

from console import SetupError

AROUND = bytes.fromhex('4889d9 488b3c24 4c89e6'), bytes.fromhex('4c8d3401')
SUBTRACT = bytes.fromhex('4c29f1')  # sub %r14,%rcx
HALVE = bytes.fromhex('48d1e9')  # shr %rcx
BROKEN = SUBTRACT.join(AROUND)
MENDED = HALVE.join(AROUND)


def libraries(environment: Path) -> list[Path]:
    """
    List the copies of the Fast DDS library that the wheels have put into the environment.

    Parameters
    ----------
    environment
        The prefix, whose folder lib holds them.

    """
    return sorted((environment / 'lib').glob('libfastrtps.so*'))


def is_mended(library: Path) -> bool:
    """
    Whether a library has the changed instruction, and not the original one.

    Parameters
    ----------
    library
        A copy of libfastrtps.so.

    """
    content = library.read_bytes()
    return content.count(MENDED) == 1 and BROKEN not in content


def mend_fast_dds(environment: Path) -> None:
    """
    Mend all copies of the Fast DDS library; harmless where they are mended already.

    Parameters
    ----------
    environment
        The prefix, whose folder lib holds them.

    Raises
    ------
    SetupError
        If there is no copy, or one is another build than that of the pinned wheel.

    """
    found = libraries(environment)
    if not found:
        raise SetupError(f"There is no libfastrtps.so in '{environment / 'lib'}'.")
    for library in found:
        if not is_mended(library):
            _mend(library)


def _mend(library: Path) -> None:
    """Replace a library in one step: who uses it goes on with the old one."""
    content = library.read_bytes()
    if content.count(BROKEN) != 1 or MENDED in content:
        raise SetupError(
            f"'{library}' is not the build of Fast DDS that tools/setup/fast_dds.py mends: nodes "
            'could hang when they end. Pin the ros-fastrtps of requirements.txt at 2.14.5, or '
            'look up whether the new version needs the mend.'
        )
    new = library.with_name(library.name + '.new')
    new.write_bytes(content.replace(BROKEN, MENDED))
    new.chmod(library.stat().st_mode)
    new.replace(library)
