/** Tabs and their keys, as the pattern of ARIA has them. */

/** Returns the tab that a key selects from the current one; undefined for other keys. */
export function tabAt<T>(key: string, tabs: readonly T[], chosen: T): T | undefined {
  if (key === 'Home') return tabs[0];
  if (key === 'End') return tabs.at(-1);
  const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
  return step === undefined ? undefined : tabs[(tabs.indexOf(chosen) + step + tabs.length) % tabs.length];
}

/** Tabs of a page or of an element's shadow root, by their `data-tab`. */
export class Tabs<T extends string> {
  readonly #buttons: readonly HTMLButtonElement[];

  /** Creates the tabs; `known` validates a name; `choose` is called with the tab that is clicked or reached by key. */
  constructor(known: (name: string) => name is T, choose: (tab: T) => void, root: ParentNode = document) {
    this.#buttons = [...root.querySelectorAll<HTMLButtonElement>('[role="tab"]')];
    const take = (button: HTMLButtonElement | undefined): void => {
      const name = button?.dataset['tab'] ?? '';
      if (known(name)) choose(name);
    };
    for (const button of this.#buttons) {
      button.addEventListener('click', () => take(button));
      button.addEventListener('keydown', (event) => {
        const next = tabAt(event.key, this.#buttons, button);
        if (next === undefined) return;
        take(next);
        next.focus();
        event.preventDefault();
      });
    }
  }

  /** Marks the tab that is chosen, and names the panel after it. */
  mark(chosen: T, panel: HTMLElement): void {
    for (const button of this.#buttons) {
      const is = button.dataset['tab'] === chosen;
      button.setAttribute('aria-selected', String(is));
      button.tabIndex = is ? 0 : -1;
      if (is) panel.setAttribute('aria-labelledby', button.id);
    }
  }
}
