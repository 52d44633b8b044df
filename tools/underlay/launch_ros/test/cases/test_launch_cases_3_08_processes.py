# SPDX-License-Identifier: Apache-2.0
"""Cases of section 3.8: processes."""

from __future__ import annotations

import os
from typing import Any

import pytest


def test_words_and_folder_and_environment(launch: Any) -> None:
    """3.8 Each item of cmd is one word; cwd and environment may be substitutions."""
    out = launch(
        """
        SetLaunchConfiguration('x', 'a b'),
        SetEnvironmentVariable('CASE_SET', 'set'),
        ExecuteProcess(
            cmd=['rec', 'one word', LaunchConfiguration('x'), '', ['x=', LaunchConfiguration('x')],
                 '$HOME', '*'],
            cwd=['su', 'b'],
            additional_env={'CASE_A': LaunchConfiguration('x'), ('CASE_', 'B'): ''},
        ),
        """,
        files={'sub/x': ''},
    )
    assert out.run.args == ['one word', 'a b', '', 'x=a b', '$HOME', '*']
    assert out.run.cwd == str(out.here / 'sub')
    env = out.run.env
    assert (env['CASE_A'], env['CASE_B'], env['CASE_SET']) == ('a b', '', 'set')
    assert 'AMENT_PREFIX_PATH' in env


def test_folder(launch: Any) -> None:
    """3.8 The folder is that of the launch if nothing else is said."""
    assert launch("ExecuteProcess(cmd=['rec']),").run.cwd == str(launch.here)


def test_whole_environment(launch: Any) -> None:
    """3.8 With env the process has that only, and additional_env on top of it."""
    out = launch(
        """
        import os
        import shutil
        rec = shutil.which('rec')
        env = {'REC_DIR': os.environ['REC_DIR'], 'CASE_A': 'env', 'CASE_B': 'env'}
        ---
        ExecuteProcess(cmd=[rec], env=env, additional_env={'CASE_B': 'more'}),
        """
    )
    env = out.run.env
    assert (env['CASE_A'], env['CASE_B']) == ('env', 'more')
    assert 'AMENT_PREFIX_PATH' not in env and 'HOME' not in env


def test_prefix(launch: Any) -> None:
    """3.8 A prefix is split like a shell does; that of the action beats the command line's."""
    entities = """
        ExecuteProcess(cmd=['rec', '1']),
        ExecuteProcess(cmd=['rec', '2'], prefix=['env CASE_P=', '"own prefix"']),
        ExecuteProcess(cmd=['sh', '-c', 'rec 3']),
    """
    out = launch(entities, 'launch-prefix:=env CASE_P="all of them"')
    env = {run.args[0]: run.env.get('CASE_P') for run in out.runs}
    assert env == {'1': 'all of them', '2': 'own prefix', '3': 'all of them'}
    assert [line for line in out.lines if 'started' in line] == [
        f'[INFO] [env-{n}]: process started with pid [N]' for n in (1, 2, 3)
    ]


def test_prefix_filter(launch: Any) -> None:
    """3.8 The filter is a pattern for the beginning of the program's name; it spares own ones."""
    out = launch(
        """
        ExecuteProcess(cmd=['rec', '1']),
        ExecuteProcess(cmd=['rec', '2'], prefix='env CASE_P=own'),
        ExecuteProcess(cmd=['/bin/sh', '-c', 'rec 3']),
        """,
        'launch-prefix:=env CASE_P=all',
        'launch-prefix-filter:=s.',
    )
    env = {run.args[0]: run.env.get('CASE_P') for run in out.runs}
    assert env == {'1': None, '2': 'own', '3': 'all'}


def test_prefix_options(launch: Any) -> None:
    """3.8 The options of the command line for prefixes are such launch arguments."""
    launch.write('it.launch.py', "ExecuteProcess(cmd=['rec']), ExecuteProcess(cmd=['true']),")
    options = ['--launch-prefix', 'env CASE_P=x', '--launch-prefix-filter', 'rec$']
    out = launch.run('launch', *options, 'it.launch.py').end()
    assert out.run.env['CASE_P'] == 'x'
    assert sorted(line for line in out.lines if 'started' in line) == [
        '[INFO] [env-1]: process started with pid [N]',
        '[INFO] [true-2]: process started with pid [N]',
    ]


def test_labels(launch: Any) -> None:
    """3.8 A label is the name or the program, and a number in the order of the visits."""
    out = launch(
        """
        SetLaunchConfiguration('n', 'named'),
        ExecuteProcess(cmd=['/bin/true']),
        ExecuteProcess(cmd=['true'], name=[LaunchConfiguration('n'), '_it']),
        ExecuteProcess(cmd=['true'], prefix='nice -n 5'),
        ExecuteProcess(cmd=['never'], condition=IfCondition('0')),
        ExecuteProcess(cmd=['echo a; true /x/last'], shell=True),
        Node(package='stub', executable='rec', name='not_this'),
        Node(package='stub', executable='rec', exec_name='this'),
        """
    )
    started = sorted(line for line in out.lines if 'started' in line)
    assert [line.split(']')[1][2:] for line in started] == [
        *['last-4', 'named_it-2', 'nice-3', 'rec-5', 'this-6', 'true-1'],
    ]


def test_shell(launch: Any) -> None:
    """3.8 With shell=True a shell reads the words joined with spaces."""
    out = launch(
        """
        ExecuteProcess(cmd=['echo one; rec', '"$CASE_X"', '| cat; exit 4'], shell=True,
                       output='screen', name='s'),
        """,
        CASE_X='a b',
    )
    assert out.run.args == ['a b']
    assert '[s-1] one' in out.lines
    assert (
        '[ERROR] [s-1]: process has died [pid N, exit code 4, cmd \'echo one; rec "$CASE_X" | '
        "cat; exit 4']."
    ) in out.lines


def test_terminal(launch: Any) -> None:
    """3.8 With emulate_tty each output is a terminal; the launch argument decides for all."""
    check = "'[ -t 1 ] && [ -t 2 ] && echo terminal || echo none; [ -t 0 ] || echo no input'"
    entities = f"""
        ExecuteProcess(cmd=['sh', '-c', {check}], output='screen'),
        ExecuteProcess(cmd=['sh', '-c', {check}], output='screen', emulate_tty=True),
    """

    def seen(*args: str) -> list[str]:
        lines: list[str] = launch(entities, *args).lines
        return sorted(line for line in lines if 'terminal' in line or 'none' in line)

    assert seen() == ['[sh-1] none', '[sh-2] terminal']
    assert seen('emulate_tty:=true') == ['[sh-1] terminal', '[sh-2] terminal']
    assert seen('emulate_tty:=0') == ['[sh-1] none', '[sh-2] none']
    assert launch(entities, 'emulate_tty:=perhaps').status == 1


def test_input(launch: Any) -> None:
    """3.8 The input of a process is open and silent: no data, and no end."""
    out = launch(
        """
        ExecuteProcess(cmd=['sh', '-c', 'read line; echo read ended'], output='screen'),
        TimerAction(period=0.5, actions=[LogInfo(msg='still reading'), Shutdown()]),
        """
    )
    assert '[sh-1] read ended' not in out.lines
    assert out.said == ['still reading']


def test_lines_of_a_process(launch: Any) -> None:
    """3.8 Start, clean end and death of a process have a line each, with its command."""
    out = launch(
        """
        ExecuteProcess(cmd=['true']),
        ExecuteProcess(cmd=['sh', '-c', 'exit 5']),
        ExecuteProcess(cmd=['sh', '-c', 'kill -INT $$']),
        Node(package='stub', executable='rec', name='n', parameters=[]),
        """,
        REC_THEN='exit 6',
    )
    assert sorted(out.lines) == [
        "[ERROR] [rec-4]: process has died [pid N, exit code 6, cmd 'PREFIX/lib/stub/rec "
        "--ros-args -r __node:=n'].",
        "[ERROR] [sh-2]: process has died [pid N, exit code 5, cmd 'sh -c exit 5'].",
        "[ERROR] [sh-3]: process has died [pid N, exit code -2, cmd 'sh -c kill -INT $$'].",
        *[
            f'[INFO] [{label}]: process started with pid [N]'
            for label in ('rec-4', 'sh-2', 'sh-3')
        ],
        '[INFO] [true-1]: process has finished cleanly [pid N]',
        '[INFO] [true-1]: process started with pid [N]',
    ]


def test_details_of_a_command(launch: Any) -> None:
    """3.8 With log_cmd the command, folder and whether the environment is own are shown."""
    out = launch(
        """
        ExecuteProcess(cmd=['true', 'a'], log_cmd=True),
        ExecuteProcess(cmd=['/bin/true'], log_cmd=True, env={'A': '1'}, cwd='/'),
        """
    )
    details = sorted(line for line in out.lines if 'process details' in line)
    assert details == [
        "[INFO] [true-1]: process details: cmd='true a', cwd='None', custom_env?=True",
        "[INFO] [true-2]: process details: cmd='/bin/true', cwd='/', custom_env?=True",
    ]


def test_program_that_cannot_be_started(launch: Any) -> None:
    """3.8 What cannot be started is an error in the log; the status stays 0."""
    launch.write('broken', '#!/no/such/interpreter').chmod(0o755)
    out = launch(
        """
        it = ExecuteProcess(cmd=['./broken'], on_exit=[LogInfo(msg='exit')])
        ---
        RegisterEventHandler(OnProcessStart(on_start=[LogInfo(msg='start')])),
        it,
        """
    )
    assert out.status == 0
    assert out.said == []
    head = '[ERROR] [broken-1]: exception occurred while executing process:'
    assert any(line.startswith(head) for line in out.lines)
    assert './broken' in out.text.partition(head)[2]


def test_program_that_does_not_exist(launch: Any) -> None:
    """3.8 A program that is missing is noticed before anything starts, unless told not to."""
    entities = "ExecuteProcess(cmd=['rec']), ExecuteProcess(cmd=['no_such_program']),"
    out = launch(entities)
    assert (out.status, out.runs) == (1, [])
    assert 'no_such_program' in out.error
    out = launch.run('launch', '--no-preflight', 'it.launch.py').end()
    assert (out.status, len(out.runs)) == (0, 1)
    head = '[ERROR] [no_such_program-2]: exception occurred while executing process:'
    assert any(line.startswith(head) for line in out.lines)


RESPAWN = """
    ExecuteProcess(cmd=['sh', '-c', 'rec "$CASE_X"; exit {status}'], respawn={respawn},
                   respawn_delay={delay}, respawn_max_retries={retries},
                   additional_env={{'CASE_X': 'same'}}),
    SetEnvironmentVariable('CASE_X', 'other'),
    ExecuteProcess(cmd=['true']),
"""


@pytest.mark.parametrize(
    ('status', 'respawn', 'delay', 'retries', 'runs'),
    [
        (0, 'True', None, 2, 3),
        (1, "'yes'", 0.1, 1, 2),
        (1, "LaunchConfiguration('r', default='false')", None, 2, 1),
        (0, 'False', None, -1, 1),
        (0, 'True', None, 0, 1),
    ],
)
def test_respawn(
    status: int, respawn: str, delay: Any, retries: int, runs: int, launch: Any
) -> None:
    """3.8 A process is started again, also after a clean end, under the same label."""
    out = launch(RESPAWN.format(status=status, respawn=respawn, delay=delay, retries=retries))
    assert [run.args for run in out.runs] == [['same']] * runs
    started = [line for line in out.lines if 'started' in line]
    assert sorted(started) == [
        *['[INFO] [sh-1]: process started with pid [N]'] * runs,
        '[INFO] [true-2]: process started with pid [N]',
    ]


def test_respawn_ends_with_the_launch(launch: Any) -> None:
    """3.8 Retries without an end stop, also in a delay, when the launch shuts down."""
    out = launch(
        """
        quick = ExecuteProcess(cmd=['rec'], respawn=True, respawn_delay=60.0)
        ---
        RegisterEventHandler(OnProcessExit(target_action=quick, on_exit=[Shutdown()])),
        quick,
        ExecuteProcess(cmd=['sleep', '60'], respawn=True),
        """
    )
    assert out.status == 0
    assert len(out.runs) == 1
    assert len([line for line in out.lines if 'sleep-2]: process started' in line]) == 1


@pytest.mark.parametrize(
    ('on_exit', 'said'),
    [
        ("[LogInfo(msg='a'), LogInfo(msg='b')]", ['a', 'b']),
        ("LogInfo(msg='a')", ['a']),
        ("lambda event, context: LogInfo(msg=f'code {event.returncode}')", ['code 3']),
        ('lambda event, context: None', []),
        # Section 6: an empty list is nothing, not an error.
        ('[]', []),
    ],
)
def test_on_exit(on_exit: str, said: list[str], launch: Any) -> None:
    """3.8 When a process ends its on_exit is visited: actions, or what a function gives."""
    out = launch(f"ExecuteProcess(cmd=['sh', '-c', 'exit 3'], on_exit={on_exit}),")
    assert (out.status, out.said) == (0, said)


OUTPUT = """
    ExecuteProcess(cmd=['sh', '-c', 'echo to out; echo to err >&2'], name='p'{output}),
"""


@pytest.mark.parametrize(
    ('output', 'screen', 'log', 'own'),
    [
        ('', 'e', 'oe', False),
        (", output='log'", 'e', 'oe', False),
        (", output='screen'", 'oe', '', False),
        (", output=TextSubstitution(text='both')", 'oe', 'oe', False),
        (", output='own_log'", '', '', True),
        (", output='full'", 'oe', 'oe', True),
        (", output={'stdout': 'screen', 'stderr': 'log'}", 'o', 'e', False),
        (", output={'both': {'screen', 'log'}}", 'oe', 'oe', False),
        (", output={'both': 'log', 'stdout': ['screen']}", 'o', 'oe', False),
        (", output={'stdout': 'own_log', 'both': 'screen'}", 'oe', '', None),
    ],
)
def test_where_output_goes(output: str, screen: str, log: str, own: Any, launch: Any) -> None:
    """3.8 The outputs of a process go to the screen, launch.log and logs of their own."""
    out = launch(OUTPUT.format(output=output))
    lines = {'o': '[p-1] to out', 'e': '[p-1] to err'}

    def shown(text: list[str]) -> set[str]:
        return {line for line in text if line.startswith('[p-1]')}

    assert shown(out.lines) == {lines[each] for each in screen}
    assert shown(out.log) == {lines[each] for each in log}
    assert out.err == ''
    files = sorted(file.name for file in (out.here / 'log/latest').iterdir())
    if own:
        assert files == ['launch.log', 'p-1-stderr.log', 'p-1-stdout.log', 'p-1.log']
        assert out.own_log('p-1-stdout.log') == '[p-1] to out\n'
        assert out.own_log('p-1-stderr.log') == '[p-1] to err\n'
        assert sorted(out.own_log('p-1.log').splitlines()) == ['[p-1] to err', '[p-1] to out']
    elif own is None:
        assert out.own_log('p-1-stdout.log') == '[p-1] to out\n'
    else:
        assert files == ['launch.log']


def test_invalid_output(launch: Any) -> None:
    """3.8 An output that is none of these is an error."""
    out = launch(OUTPUT.format(output=", output='paper'"))
    assert out.status == 1
    assert (
        'paper is not a valid standard output config i.e. "screen", "log" or "both"'
    ) in out.error


def test_output_of_all(launch: Any) -> None:
    """3.8 A variable of the environment, or the option -a, decides for all outputs."""
    entities = OUTPUT.format(output=", output='log'")
    out = launch(entities, OVERRIDE_LAUNCH_PROCESS_OUTPUT='own_log')
    assert '[p-1]' not in out.text.replace('[INFO] [p-1]', '')
    out = launch(entities, '-a')
    assert {'[p-1] to out', '[p-1] to err'} <= set(out.lines)
    assert {'[p-1] to out', '[p-1] to err'} <= set(out.log)


def test_lines_of_output(launch: Any) -> None:
    """3.8 Output comes in whole lines; what has no end comes when the process has ended."""
    out = launch(
        r"""
        script = r'''
        printf 'first half'; sleep 0.3; printf ', second half\n'
        printf 'one\ntwo\nthree'; sleep 0.3; printf ' and more'; printf '\n\n'
        printf 'bad \377 byte\n'
        printf 'no end'
        '''
        ---
        ExecuteProcess(cmd=['sh', '-c', script], output='screen'),
        """
    )
    told = [line for line in out.lines if line.startswith('[sh-1]')]
    assert told == [
        *['[sh-1] first half, second half', '[sh-1] one', '[sh-1] two', '[sh-1] three and more'],
        *['[sh-1] ', '[sh-1] bad \ufffd byte', '[sh-1] no end'],
    ]


def test_format_of_output(launch: Any) -> None:
    """3.8 The format of the lines can be set."""
    out = launch(
        """
        ExecuteProcess(cmd=['echo', 'text'], output='screen', output_format='{line} <- '
                       '{this.process_description.final_name}'),
        """
    )
    assert 'text <- echo-1' in out.lines


def test_properties(launch: Any) -> None:
    """3.8 An action knows how its process was started, how it ended, and what it wrote."""
    out = launch(
        """
        it = ExecuteProcess(cmd=['sh', '-c', 'echo out; echo err >&2; exit 3'], name='n',
                            cached_output=True, cwd='/', additional_env={'CASE_A': '1'})

        def look(context):
            print(it.return_code, repr(it.get_stdout()), repr(it.get_stderr()), flush=True)
            details = it.process_details
            print(details['name'], details['cmd'][0], details['cwd'], details['env']['CASE_A'])
            print(it.name, it.cmd[0], it.cwd, it.env['CASE_A'], details['pid'] > 0, flush=True)
        ---
        OpaqueFunction(function=lambda context: print(it.return_code, it.process_details)),
        RegisterEventHandler(OnShutdown(on_shutdown=[OpaqueFunction(function=look)])),
        it,
        """
    )
    assert [line for line in out.lines if line[0] not in '[ '] == [
        'None None',
        "3 'out\\n' 'err\\n'",
        'n-1 sh / 1',
        'n-1 sh / 1 True',
    ]


def test_underlying_pair(launch: Any) -> None:
    """3.8 A process is an ExecuteLocal of an Executable."""
    out = launch(
        """
        from launch.actions import ExecuteLocal
        from launch.descriptions import Executable
        ---
        ExecuteLocal(process_description=Executable(
            cmd=['rec'], arguments=['a', 'b'], prefix='env CASE_P=1', name='n')),
        """
    )
    assert (out.run.args, out.run.env['CASE_P']) == (['a', 'b'], '1')
    assert '[INFO] [n-1]: process started with pid [N]' in out.lines


def test_environment_has_nothing_added(launch: Any) -> None:
    """3.8 A process gets the environment as it is; but Python's output is not late (README)."""
    out = launch(
        """
        ExecuteProcess(cmd=['rec']),
        ExecuteProcess(cmd=['python3', '-c', 'import os; print(os.environ["PYTHONUNBUFFERED"])'],
                       output='screen'),
        """
    )
    added = {name for name in out.run.env if name not in os.environ}
    assert added <= {'REC_DIR', 'ROS_LOG_DIR', 'TMPDIR', 'OLDPWD', 'SHLVL', '_'}
    assert 'PYTHONUNBUFFERED' not in out.run.env
    assert '[python3-2] 1' in out.lines
