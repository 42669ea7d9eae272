// SPDX-License-Identifier: Apache-2.0
// What the list of projects says of one.

import assert from 'node:assert/strict';
import {test} from 'node:test';

import {moreText, size, stateText} from '../../client_web/projects/projects.js';

const project = {name: 'box', title: 'Box', path: 'p/box/', state: 'ASLEEP', needsToken: false};

test('who is there comes before the state', () => {
    assert.equal(stateText(project), 'Asleep, wakes at once');
    assert.equal(stateText({...project, people: ['Ada', 'Ben']}), 'Ada, Ben');
    assert.equal(stateText({...project, people: ['', 'Ben']}), 'Somebody, Ben');
    assert.equal(stateText({...project, people: ['a', 'b', 'c', 'd', 'e']}), 'a, b, c and 2 more');
    assert.equal(
        stateText({...project, state: 'FAILED', problem: 'its scene is not accepted'}),
        'Not available: its scene is not accepted',
    );
});

test('sizes are said as far as they are known', () => {
    assert.equal(size(8396), '9 kB');
    assert.equal(size(1.24e6), '1.2 MB');
    assert.equal(size(340e6), '340 MB');
    assert.equal(size(2.5e9), '2.5 GB');
    assert.equal(moreText({...project, needsToken: true}), 'Opens with a token');
    assert.equal(
        moreText({...project, sceneBytes: 2e6, memoryBytes: 4e8, maxViewers: 1}),
        'Scene 2.0 MB · memory 400 MB · up to 1 person',
    );
});
