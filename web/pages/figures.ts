/** Figures of the library for menus: names of their files, and of the figures. */
export const FIGURES: Readonly<Record<string, string>> = {
  sofia: 'Sofia',
  papous: 'Papous',
  nuno: 'Nuno',
  amara: 'Amara',
  kenji: 'Kenji',
  lia: 'Lia',
};
