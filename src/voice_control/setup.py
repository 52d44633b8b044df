# SPDX-License-Identifier: Apache-2.0
"""Install voice_control."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'voice_control'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
    ],
    entry_points={
        'console_scripts': [
            'audio_source = voice_control.audio_source:main',
            'speaker = voice_control.speaker:main',
            'speech_recognizer = voice_control.speech_recognizer:main',
        ],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='From a microphone to commands, and from texts to a loudspeaker',
    license='Apache-2.0',
)
