# SPDX-License-Identifier: Apache-2.0
"""Check that the discovery servers answer through which nodes are to find each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
import os
from pathlib import Path
import re
import shutil

from ros2cli.graph.probe import Answer, ask_servers
from ros2cli.graph.servers import read_servers, SERVERS, SUPER_CLIENT, udp_host
from ros2doctor.api.extension import DoctorCheck, DoctorReport, Finding, Report, Result, Severity
from ros2doctor.check.wheels import environment_prefix

PROGRAM = 'fast-discovery-server'
PEERS = 'ROS_STATIC_PEERS'
LIBRARY = re.compile(r'libfastrtps\.so\.(\d+\.\d+\.\d+)')
SECURITY = b'builtin.PKI-DH'  # the name of the plugin for authentication
NOBODY = (
    'each node prints an error, leaves out all servers and finds nobody; the running nodes were '
    'not examined'
)
SUPER_CLIENT_VALUES = ('TRUE', 'True', 'true', '1', 'FALSE', 'False', 'false', '0')


@dataclass(frozen=True)
class Discovery:
    """
    Facts about discovery through servers.

    :param answers: what each address of ROS_DISCOVERY_SERVER has answered
    :param mistake: why the list of addresses is not valid, or ''
    :param version: the version of Fast DDS, or '' if it is not found
    :param has_security: whether Fast DDS has its plugins for DDS security
    :param program: the path of the program that runs a server; None if there is none
    """

    variables: Mapping[str, str]
    answers: tuple[Answer, ...] = ()
    mistake: str = ''
    version: str = ''
    has_security: bool = False
    program: str | None = None


def read_discovery() -> Discovery:
    """Return the facts, after asking each server."""
    answers: tuple[Answer, ...] = ()
    mistake = ''
    try:
        answers = ask_servers(read_servers())
    except RuntimeError as error:
        mistake = str(error)
    library = _library()
    return Discovery(
        variables=dict(os.environ),
        answers=answers,
        mistake=mistake,
        version=_version(library),
        has_security=library is not None and SECURITY in library.read_bytes(),
        program=shutil.which(PROGRAM),
    )


@cache
def why_no_graph() -> str:
    """Return why the discovery servers cannot be asked for the running nodes; '' if they can."""
    try:
        for server in read_servers():
            udp_host(server)
    except RuntimeError as error:
        return str(error)
    return ''


def _library() -> Path | None:
    found = sorted(Path(environment_prefix(), 'lib').glob('libfastrtps.so.*.*.*'))
    return found[-1] if found else None


def _version(library: Path | None) -> str:
    match = LIBRARY.fullmatch(library.name) if library else None
    return match[1] if match else ''


class ServersCheck(DoctorCheck):
    """Check of the discovery servers."""

    def category(self) -> str:
        """Return the category."""
        return 'discovery servers'

    def check(self) -> Result:
        """Check that each server answers."""
        findings = [*server_findings(read_discovery())]
        why = '' if findings else why_no_graph()
        if why:
            findings.append(Finding(Severity.WARNING, why, 'the running nodes were not examined'))
        return Result(findings)


def server_findings(facts: Discovery) -> Iterator[Finding]:
    """
    Report discovery servers that do not answer, and variables that do not fit.

    Parameters
    ----------
    facts
        The facts, as `read_discovery` gives them.

    Yields
    ------
    Finding
        An error if nodes find nobody, else a warning.

    """
    if facts.mistake:
        yield Finding(
            Severity.ERROR,
            facts.mistake,
            NOBODY,
            f'correct it, or do without: unset {SERVERS}',
        )
    is_reached = any(not each.error for each in facts.answers)
    for each in facts.answers:
        if each.is_unresolved:
            yield Finding(Severity.ERROR, each.error, NOBODY, f'correct it, or: unset {SERVERS}')
        elif each.error:
            yield _silent(each, Severity.WARNING if is_reached else Severity.ERROR)
        elif each.number not in (None, each.server.number):
            yield _other_number(each)
    yield from _variables(facts.variables)


def _silent(answer: Answer, severity: Severity) -> Finding:
    server = answer.server
    others = severity is Severity.WARNING
    return Finding(
        severity,
        f'no discovery server answers at {server}: {answer.error}',
        'nodes are found through the other servers only, and by nobody if these end'
        if others
        else f'with {SERVERS} set, nodes find each other through a server only: not even those '
        'on this machine are found',
        f'start one there: {server.start_command}; a firewall there has to let {server.kind[:3]} '
        f'port {server.port} in; or do without: unset {SERVERS}',
    )


def _other_number(answer: Answer) -> Finding:
    server = answer.server
    return Finding(
        Severity.ERROR,
        f'the discovery server at {server} has the ID {answer.number}, but {SERVERS} has it at '
        f'position {server.number}, counted from 0',
        'nodes do not listen to a server with another ID than its position',
        f"export {SERVERS}='{';' * (answer.number or 0)}{server}', or start it with "
        f'-i {server.number}',
    )


def _variables(variables: Mapping[str, str]) -> Iterator[Finding]:
    """Yield the variables that do not fit."""
    if variables.get(SERVERS) and variables.get(PEERS):
        yield Finding(
            Severity.WARNING,
            f'{PEERS} has no effect, because {SERVERS} is set',
            'nodes ask only the discovery servers, and not the peers',
            f'unset {PEERS}, or: unset {SERVERS}',
        )
    value = variables.get(SUPER_CLIENT, '')
    if value and value not in SUPER_CLIENT_VALUES:
        yield Finding(
            Severity.WARNING,
            f"{SUPER_CLIENT} is '{value}', which is neither TRUE nor FALSE",
            'each node prints an error, and is told only about the nodes that share a topic',
            f'export {SUPER_CLIENT}=TRUE, or: unset {SUPER_CLIENT}',
        )


class ServersReport(DoctorReport):
    """Report of Fast DDS and its discovery servers."""

    def category(self) -> str:
        """Return the category."""
        return 'discovery servers'

    def report(self) -> Report:
        """Return the section."""
        facts = read_discovery()
        report = Report('DISCOVERY SERVERS')
        report.add_to_report('Fast DDS', facts.version or 'not found')
        report.add_to_report('DDS security', 'available' if facts.has_security else 'not built in')
        report.add_to_report('program', facts.program or f'{PROGRAM} is not on the PATH')
        report.add_to_report('super client', facts.variables.get(SUPER_CLIENT, '') or 'FALSE')
        for each in facts.answers:
            report.add_to_report(f'server {each.server.number}', _state(each))
        if facts.mistake:
            report.add_to_report('servers', facts.mistake)
        elif not facts.answers:
            report.add_to_report('servers', 'none: nodes discover each other')
        return report


def _state(answer: Answer) -> str:
    return f'{answer.server}, {answer.error or "answers"}'
