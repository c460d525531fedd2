/** Pictures of questions, from the story's folder. */

/** Returns the URL of a file in the folder of a story. The name is escaped completely, so it cannot lead to another folder. */
export function addressOf(file: string, story: URL): string {
  const steps = file.split('/').filter((step) => step !== '..');
  return new URL(`./${steps.map(encodeURIComponent).join('/')}`, story).href;
}
