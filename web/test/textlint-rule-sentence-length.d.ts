/** A rule of textlint without types of its own. */
declare module 'textlint-rule-sentence-length' {
  import type { TextlintRuleModule } from '@textlint/kernel';

  const rule: TextlintRuleModule;
  export default rule;
}
