// Shows how far each lesson is, as the page of a course keeps it in the browser (`raconteur-course:` and the lesson's address).

function keptOf(course) {
  try {
    return JSON.parse(localStorage.getItem(`raconteur-course:${course}`)) ?? {};
  } catch {
    // The browser keeps nothing here, or something else.
    return {};
  }
}

function show() {
  for (const item of document.querySelectorAll('[data-course]')) {
    const { progress, isComplete } = keptOf(item.dataset.course);
    const share = isComplete === true ? 1 : Math.min(1, Math.max(0, Number(progress) || 0));
    item.querySelector('progress').value = share;
    item.querySelector('span').textContent = isComplete === true ? '✓' : `${Math.floor(100 * share)} %`;
  }
}

show();
// Whoever comes back by the browser's own way has gone on meanwhile.
addEventListener('pageshow', show);
