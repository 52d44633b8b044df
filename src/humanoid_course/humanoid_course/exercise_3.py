# SPDX-License-Identifier: Apache-2.0
"""Exercise 3: a package of robot models, and one that depends on it and loads a model."""

from __future__ import annotations

from humanoid_course import common_checks as common
from humanoid_course.common_checks import Check
from humanoid_course.grading import Exercise, failed, passed, Verdict
from humanoid_course.observations import MODEL_MARK, Run, Submission
from humanoid_course.report import quoted
from humanoid_course.workspace import MANIFEST, read_manifest

CONTROL, MODELS = 'robot_control', 'robot_description'


def check_models(submission: Submission) -> Verdict:
    """
    Check that the package of models installs models, and no programs.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    build, name = submission.build(), submission.packages[1].name
    models = build.models.get(name, ())
    if not models:
        return failed(
            f'{name} installs no URDF file with a named <robot>',
            f'at least one in share/{name}/urdf',
            f"Put it into urdf/, and add ('share/{name}/urdf', glob('urdf/*')) to data_files in "
            'setup.py, with `from glob import glob` at its beginning.',
        )
    programs = build.executables.get(name, ())
    if programs:
        return failed(
            f'{name} installs programs: {quoted(programs)}',
            'a package of URDF files only',
            f'Move the nodes to {submission.packages[0].name}.',
        )
    return passed(quoted(models))


def check_dependency(submission: Submission) -> Verdict:
    """
    Check that the manifest declares the dependency on the package of models.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    control, models = (each.name for each in submission.packages)
    depends = read_manifest(submission.packages[0].folder).depends
    if models not in depends:
        return failed(
            f'{MANIFEST} of {control} names: {quoted(sorted(depends))}',
            f'<depend>{models}</depend>',
            f'Add that line to {submission.packages[0].folder / MANIFEST}: colcon then builds '
            f'{models} first.',
        )
    return passed(f'{control} depends on {models}')


def check_launch(submission: Submission) -> Verdict:
    """
    Check that the launch file starts nodes that keep running.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run = submission.launch(_has_model)
    if not run.command:
        return common.missing_launch_file(submission, 'a node with the model')
    expected = 'a launch that runs until Ctrl-C, with at least one node'
    if not run.ran or not run.nodes:
        what = 'ended by itself' if not run.ran else 'starts no node'
        return failed(
            f'{run.command} {what}; {common.last_line(run.output)}',
            expected,
            'Run that command, and correct the error that it reports.',
        )
    return passed(f'{run.command}: {quoted(run.nodes)}')


def check_model_is_loaded(submission: Submission) -> Verdict:
    """
    Check that a node got a model that was renamed in the installed package of models.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    run, models = submission.launch(_has_model), submission.packages[1].name
    where = places_of_model(run)
    if where:
        return passed(f'the model of {models} is in {where[0]}')
    given = sorted(name for name, text in run.parameters.items() if '<robot' in text)
    found = (
        f'{given[0]} is a model, but not that of the installed {models}: the robot there was '
        'renamed for this check'
        if given
        else f'no parameter, topic or output of {quoted(run.nodes)} has the model of {models}'
    )
    return failed(
        found,
        f'the URDF of {models} as the parameter robot_description of a node',
        f"Read it from get_package_share_directory('{models}') + '/urdf/...' in the launch file, "
        'and pass it in parameters=[{...}].',
    )


def places_of_model(run: Run) -> list[str]:
    """
    List where the renamed model turned up: parameters, topics, output.

    Parameters
    ----------
    run
        What the launch did.

    """
    places = [f'the parameter {name}' for name, text in run.parameters.items() if _is_it(text)]
    places += [
        f'the topic {topic}'
        for topic, values in run.values.items()
        if any(isinstance(each, str) and _is_it(each) for each in values)
    ]
    return places + (['the output'] if _is_it(run.output) else [])


def check_launch_end(submission: Submission) -> Verdict:
    """
    Check that Ctrl-C ends the launch with everything that it started.

    Parameters
    ----------
    submission
        The packages of the student.

    """
    return common.check_end(submission.launch(_has_model), 'the launch with all its nodes')


def _is_it(text: str) -> bool:
    return MODEL_MARK in text


def _has_model(run: Run) -> bool:
    return bool(run.nodes and places_of_model(run))


EXERCISE = Exercise[Submission](
    'exercise_3',
    'create a package that depends on another one',
    (CONTROL, MODELS),
    (
        common.MANIFESTS,
        common.DEPENDENCIES,
        Check(
            'dependency',
            f'{CONTROL} declares that it depends on {MODELS}',
            check_dependency,
            ('manifest',),
        ),
        Check('build', 'both packages build without errors', common.check_build, ('manifest',)),
        Check('models', f'{MODELS} has URDF files, and nothing else', check_models, ('build',)),
        Check('launch', 'the launch file works', check_launch, ('models',)),
        Check(
            'access',
            f'{CONTROL} loads the URDF from {MODELS}',
            check_model_is_loaded,
            ('launch',),
        ),
        Check(
            'launch_end',
            'one Ctrl-C ends the launch and its nodes',
            check_launch_end,
            ('launch',),
        ),
    ),
    launch_words=(MODELS,),
)
