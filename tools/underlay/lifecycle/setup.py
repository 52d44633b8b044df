# SPDX-License-Identifier: Apache-2.0
"""Installation of the package."""

from glob import glob

from setuptools import find_packages, setup

package_name = 'lifecycle'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
        (f'share/{package_name}/launch', glob('launch/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The nodes of the tutorial about nodes with a lifecycle.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'lifecycle_talker = lifecycle.lifecycle_talker:main',
            'lifecycle_listener = lifecycle.lifecycle_listener:main',
            'lifecycle_service_client = lifecycle.lifecycle_service_client:main',
        ],
    },
)
