// SPDX-License-Identifier: Apache-2.0

/**
 * Runs an action at most once per animation frame: at once the first time, and once more at the
 * next frame if it was asked for again meanwhile.
 */
export class FrameThrottle {
    #scheduled = 0;
    #again = false;

    /** @param {() => void} action */
    constructor(action) {
        this.action = action;
    }

    /** Asks for the action. */
    run() {
        if (this.#scheduled) {
            this.#again = true;
            return;
        }
        this.#scheduled = requestAnimationFrame(() => {
            this.#scheduled = 0;
            if (this.#again) {
                this.#again = false;
                this.run();
            }
        });
        this.action();
    }

    /** Forgets what has been asked for and not been done. */
    cancel() {
        this.#again = false;
    }
}
